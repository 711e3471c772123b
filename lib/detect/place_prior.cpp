#include "detect/place_prior.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "detect/odds.hpp"

namespace d2b {
namespace {

constexpr std::size_t fewest_candidates = 100;
constexpr double most_filled = 0.1;
constexpr double likely = 0.5;
constexpr double beyond_doubt = 0.95;
constexpr std::int64_t likely_per_sure = 5;  // at most
constexpr double usual_share = 0.62;
// Factors for scenes almost without certain buildings. The estimate then rests on few candidates with an
// unusual appearance: in sparsely scanned villages it is half of the true share.
constexpr double surely = 0.9;
constexpr std::int64_t fields_likely_per_sure = 10;  // more than this
constexpr double added_to_few = 1;
constexpr double estimates_at_most = 2.5;
constexpr int most_steps = 500;
constexpr double small_step = 1e-7;

// The log likelihood ratio is linear in the log-odds of judge(). This line was fitted independently to the
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
        if (is_candidate(object))
            ratios.push_back(ratio_of(object));
    return ratios;
}

/// Upper bound of the share of buildings if hardly any candidate is certain.
double most_of_few(std::span<const double> ratios) {
    return std::min(usual_share, estimates_at_most * share_of_buildings(ratios, added_to_few));
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
        if (is_candidate(object)) {
            sum += object.confidence;
            count += 1;
        }
    return count > 0 ? sum / count : usual_share;
}

/// Range of shares implied by the confidences: between a share and their own mean.
SupposedShare supposed_around(double share, const std::vector<DetectedObject>& objects, bool as_elsewhere) {
    const double mean = mean_confidence(objects);
    return {std::min(mean, share), std::max(mean, share), as_elsewhere};
}

/// Replaces the usual prior share by another one.
void suppose(double share, std::span<DetectedObject> objects) {
    if (share == usual_share)
        return;
    const double change = odds(share) / odds(usual_share);
    for (DetectedObject& object : objects)
        if (is_candidate(object))
            object.confidence = probability_of(odds(object.confidence) * change);
}

}  // namespace

bool is_candidate(const DetectedObject& object) {
    return object.confidence > 0 && object.confidence < 1;
}

bool looks_as_elsewhere(const std::vector<DetectedObject>& objects) {
    return likely_per_sure * above(beyond_doubt, objects) >= above(likely, objects);
}

bool hardly_any_is_sure(const std::vector<DetectedObject>& objects) {
    return fields_likely_per_sure * (above(surely, objects) - 1) < above(likely, objects);
}

double share_of_buildings(std::span<const double> ratios, double added) {
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

SupposedShare correct_for_place(double filled, std::vector<DetectedObject>& objects,
                                std::span<DetectedObject> others) {
    const std::vector<double> ratios = ratios_of(objects);
    const bool as_elsewhere = looks_as_elsewhere(objects);
    if (filled > most_filled || ratios.size() < fewest_candidates || !as_elsewhere) {
        const double share = hardly_any_is_sure(objects) ? most_of_few(ratios) : usual_share;
        suppose(share, objects);
        suppose(share, others);
        return supposed_around(share, objects, as_elsewhere);
    }
    const double share = share_of_buildings(ratios);
    if (share >= usual_share)
        return supposed_around(usual_share, objects, as_elsewhere);
    for (DetectedObject& object : objects)
        if (is_candidate(object))
            object.confidence = posterior(ratio_of(object), share);
    return {share, share, as_elsewhere};
}

}  // namespace d2b
