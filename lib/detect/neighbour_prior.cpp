#include "detect/neighbour_prior.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "detect/odds.hpp"

namespace d2b {
namespace {

// Radii up to 300 m are equally good in the places of docs/accuracy.md; units have a halo of that size.
constexpr double reach_m = 150;
constexpr std::size_t no_witness = std::numeric_limits<std::size_t>::max();

struct Candidate {
    double down = 0;  // metres
    double across = 0;
    double confidence = 0;
    std::size_t object = 0;  ///< index among the reference objects; no_witness if it is not one of them
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
        : strips_(static_cast<std::size_t>(height / reach_m) + 1) {
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
            for (auto other =
                     std::ranges::lower_bound(strips_[i], middle.across - reach_m, {}, &Candidate::across);
                 other != strips_[i].end() && other->across <= middle.across + reach_m; ++other) {
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
        return static_cast<std::size_t>(candidate.down / reach_m);
    }
    /// Decreases smoothly from 1 to 0 at the radius.
    static double weight_of(const Candidate& other, const Candidate& middle) {
        const double down = (other.down - middle.down) / reach_m;
        const double across = (other.across - middle.across) / reach_m;
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
        if (is_candidate(objects[i])) {
            const auto cells = static_cast<double>(regions.cells[i + 1]);
            result.push_back({static_cast<double>(sums[i].rows) / cells * cell.down,
                              static_cast<double>(sums[i].cols) / cells * cell.across, objects[i].confidence,
                              i});
        }
    return result;
}

void correct(const Strips& witnesses, const Candidate& candidate, const SupposedShare& supposed,
             DetectedObject& object) {
    const double share = witnesses.share_around(candidate, (supposed.least + supposed.most) / 2);
    const double change = odds(share) / odds(std::clamp(share, supposed.least, supposed.most));
    object.confidence = probability_of(odds(candidate.confidence) * change);
}

}  // namespace

void correct_for_neighbours(const Regions& regions, const CellSize& cell, const SupposedShare& supposed,
                            std::vector<DetectedObject>& objects, Executor& threads) {
    const Strips strips(candidates_of(regions, cell, objects, threads), regions.rows * cell.down);
    threads.for_each(strips.all().size(), [&](std::size_t i) {
        for (const Candidate& candidate : strips.all()[i])
            correct(strips, candidate, supposed, objects[candidate.object]);
    });
}

void correct_for_witnesses(const JudgedObjects& witnesses, const CellSize& cell,
                           const SupposedShare& supposed, JudgedObjects& judged, Executor& threads) {
    const Regions& around = witnesses.regions;
    const Strips strips(candidates_of(around, cell, witnesses.objects, threads), around.rows * cell.down);
    std::vector<Candidate> candidates = candidates_of(judged.regions, cell, judged.objects, threads);
    threads.for_each(candidates.size(), [&](std::size_t i) {
        DetectedObject& object = judged.objects[std::exchange(candidates[i].object, no_witness)];
        correct(strips, candidates[i], supposed, object);
    });
}

}  // namespace d2b
