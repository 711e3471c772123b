#include "detect/priors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "detect/sampling_rules.hpp"

namespace d2b::detect {
namespace {

constexpr std::size_t fewest_candidates = 100;
constexpr double likely = 0.5;
constexpr double beyond_doubt = 0.95;
constexpr std::int64_t likely_per_sure = 5;  // at most
constexpr double usual_share = 0.62;
// Factors for scenes almost without certain buildings. The estimate then rests on few candidates with an
// unusual appearance: in sparsely scanned villages it is half of the true share.
constexpr double surely = 0.9;
constexpr std::int64_t max_likely_per_sure_of_few = 10;  // more than this
constexpr double added_to_few = 1;
constexpr double estimates_at_most = 2.5;
constexpr int most_steps = 500;
constexpr double small_step = 1e-7;

// The log likelihood ratio is linear in the log-odds of classify(). This line was fitted independently to the
// two places of docs/accuracy.md with hundreds of candidates, and was the same for both; at the usual share
// the log-odds are 0.
constexpr double steepness = 1.4;
const double offset = -std::log(usual_share / (1 - usual_share));

/// Posterior probability of a building, given the likelihood ratio and the prior share.
double posterior(double ratio, double share) {
    return ratio * share / (ratio * share + 1 - share);
}

double ratio_of(const DetectedObject& object) {
    return std::exp(steepness * std::log(odds(object.confidence)) + offset);
}

std::vector<double> ratios_of(const std::vector<DetectedObject>& objects) {
    std::vector<double> ratios;
    for (const DetectedObject& object : objects)
        if (is_ambiguous(object))
            ratios.push_back(ratio_of(object));
    return ratios;
}

/// Upper bound of the share of buildings if hardly any candidate is certain.
double max_share_of_few(std::span<const double> ratios) {
    return std::min(usual_share, estimates_at_most * estimate_building_share(ratios, added_to_few));
}

std::int64_t above(double confidence, const std::vector<DetectedObject>& objects) {
    return std::ranges::count_if(
        objects, [&](const DetectedObject& object) { return object.confidence > confidence; });
}

/// Mean confidence of candidates; the usual share if there are none.
double mean_confidence(const std::vector<DetectedObject>& objects) {
    double sum = 0;
    double count = 0;
    for (const DetectedObject& object : objects)
        if (is_ambiguous(object)) {
            sum += object.confidence;
            count += 1;
        }
    return count > 0 ? sum / count : usual_share;
}

/// Range of shares implied by the confidences: between a share and their own mean.
PriorShare prior_around(double share, const std::vector<DetectedObject>& objects, bool usual_appearance) {
    const double mean = mean_confidence(objects);
    return {std::min(mean, share), std::max(mean, share), usual_appearance};
}

/// Replaces the usual prior share by another one.
void replace_prior(double share, std::vector<DetectedObject>& objects) {
    if (share == usual_share)
        return;
    const double change = odds(share) / odds(usual_share);
    for (DetectedObject& object : objects)
        if (is_ambiguous(object))
            object.confidence = probability_of(odds(object.confidence) * change);
}

// Radii up to 300 m are equally good in the places of docs/accuracy.md; units have a halo of that size.
constexpr double neighbour_reach_m = 150;

struct Candidate {
    double down = 0;  // metres
    double across = 0;
    double confidence = 0;
    std::size_t object = 0;  ///< its index
};

/// Integer sums of rows and columns, exact in any order.
struct CellSums {
    std::int64_t rows = 0;
    std::int64_t cols = 0;
};

std::vector<CellSums> cell_sums(const Regions& regions, Executor& threads) {
    std::vector<CellSums> sums(regions.count());
    for_runs_by_label(threads, regions, [&](std::int32_t r, const RegionRun& run) {
        CellSums& sum = sums[run.label - 1];
        const std::int64_t cells = run.end - run.begin;
        sum.rows += r * cells;
        sum.cols += (std::int64_t{run.begin} + run.end - 1) * cells / 2;
    });
    return sums;
}

/// Spatial index: candidates in horizontal strips as high as the radius, each sorted from left to right.
class Strips {
  public:
    Strips(const std::vector<Candidate>& candidates, double height)
        : strips_(static_cast<std::size_t>(height / neighbour_reach_m) + 1) {
        for (const Candidate& candidate : candidates)
            strips_[strip_of(candidate)].push_back(candidate);
        for (std::vector<Candidate>& strip : strips_)
            std::ranges::stable_sort(strip, {}, &Candidate::across);
    }
    [[nodiscard]] std::span<const std::vector<Candidate>> all() const { return strips_; }

    /// Weighted mean confidence around a candidate, excluding itself.
    /// @param usual confidence of one pseudo-candidate
    [[nodiscard]] double share_around(const Candidate& middle, double usual) const {
        double sum = usual;
        double weights = 1;
        const std::size_t strip = strip_of(middle);
        for (std::size_t i = strip == 0 ? 0 : strip - 1; i <= std::min(strip + 1, strips_.size() - 1); ++i)
            for (auto other = std::ranges::lower_bound(strips_[i], middle.across - neighbour_reach_m, {},
                                                       &Candidate::across);
                 other != strips_[i].end() && other->across <= middle.across + neighbour_reach_m; ++other) {
                if (other->object == middle.object)
                    continue;
                const double weight = weight_of(*other, middle);
                sum += weight * other->confidence;
                weights += weight;
            }
        return sum / weights;
    }

  private:
    static std::size_t strip_of(const Candidate& candidate) {
        return static_cast<std::size_t>(candidate.down / neighbour_reach_m);
    }
    /// Decreases smoothly from 1 to 0 at the radius.
    static double weight_of(const Candidate& other, const Candidate& middle) {
        const double down = (other.down - middle.down) / neighbour_reach_m;
        const double across = (other.across - middle.across) / neighbour_reach_m;
        const double left = std::max(0.0, 1 - down * down - across * across);
        return left * left;
    }

    std::vector<std::vector<Candidate>> strips_;
};

std::vector<Candidate> candidates_of(const Regions& regions, const CellSize& cell,
                                     const std::vector<DetectedObject>& objects, Executor& threads) {
    const std::vector<CellSums> sums = cell_sums(regions, threads);
    std::vector<Candidate> result;
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (is_ambiguous(objects[i])) {
            const auto cells = static_cast<double>(regions.cells[i + 1]);
            result.push_back({static_cast<double>(sums[i].rows) / cells * cell.down,
                              static_cast<double>(sums[i].cols) / cells * cell.across, objects[i].confidence,
                              i});
        }
    return result;
}

void correct(const Strips& all, const Candidate& candidate, const PriorShare& prior, DetectedObject& object) {
    const double share = all.share_around(candidate, (prior.least + prior.most) / 2);
    const double change = odds(share) / odds(std::clamp(share, prior.least, prior.most));
    object.confidence = probability_of(odds(candidate.confidence) * change);
}

}  // namespace

bool is_ambiguous(const DetectedObject& object) {
    return object.confidence > 0 && object.confidence < 1;
}

bool has_usual_appearance(const std::vector<DetectedObject>& objects) {
    return likely_per_sure * above(beyond_doubt, objects) >= above(likely, objects);
}

bool lacks_certain_buildings(const std::vector<DetectedObject>& objects) {
    return max_likely_per_sure_of_few * (above(surely, objects) - 1) < above(likely, objects);
}

double estimate_building_share(std::span<const double> ratios, double added) {
    double share = usual_share;
    for (int step = 0; step < most_steps; ++step) {
        double sum = added * usual_share;
        for (const double ratio : ratios)
            sum += posterior(ratio, share);
        const double next = sum / (added + static_cast<double>(ratios.size()));
        if (std::abs(next - share) < small_step)
            return next;
        share = next;
    }
    return share;
}

PriorShare apply_scene_prior(double filled, std::vector<DetectedObject>& objects) {
    const std::vector<double> ratios = ratios_of(objects);
    const bool usual_appearance = has_usual_appearance(objects);
    if (has_very_sparse_points(filled) || ratios.size() < fewest_candidates || !usual_appearance) {
        const double share = lacks_certain_buildings(objects) ? max_share_of_few(ratios) : usual_share;
        replace_prior(share, objects);
        return prior_around(share, objects, usual_appearance);
    }
    const double share = estimate_building_share(ratios);
    if (share >= usual_share)
        return prior_around(usual_share, objects, usual_appearance);
    for (DetectedObject& object : objects)
        if (is_ambiguous(object))
            object.confidence = posterior(ratio_of(object), share);
    return {share, share, usual_appearance};
}

void apply_spatial_prior(const Regions& regions, const CellSize& cell, const PriorShare& prior,
                         std::vector<DetectedObject>& objects, Executor& threads) {
    const Strips strips(candidates_of(regions, cell, objects, threads), regions.rows * cell.down);
    threads.for_each(strips.all().size(), [&](std::size_t i) {
        for (const Candidate& candidate : strips.all()[i])
            correct(strips, candidate, prior, objects[candidate.object]);
    });
}

}  // namespace d2b::detect
