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
constexpr double usual_candidates = 50;
constexpr int most_steps = 500;
constexpr double small_step = 1e-7;

// The logarithm of the likelihood ratio is a line in the log-odds that judge() gives. Of each of the two
// places of docs/accuracy.md that have hundreds of candidates this line was found, and it was the same; where
// it says nothing, at the usual share, the log-odds are 0.
constexpr double steepness = 1.4;
const double offset = -std::log(usual_share / (1 - usual_share));

/// The probability of a building where so many are.
double posterior(double ratio, double share) {
    return ratio * share / (ratio * share + 1 - share);
}

double ratio_of(const DetectedObject& object) {
    return std::exp(steepness * std::log(odds(object.confidence)) + offset);
}

std::int64_t above(double confidence, const std::vector<DetectedObject>& objects) {
    return std::ranges::count_if(
        objects, [&](const DetectedObject& object) { return object.confidence > confidence; });
}

/// Mean confidence of candidates; the usual share where there is none.
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

SupposedShare not_corrected(const std::vector<DetectedObject>& objects, bool as_elsewhere) {
    const double mean = mean_confidence(objects);
    return {std::min(mean, usual_share), std::max(mean, usual_share), as_elsewhere};
}

}  // namespace

bool is_candidate(const DetectedObject& object) {
    return object.confidence > 0 && object.confidence < 1;
}

bool looks_as_elsewhere(const std::vector<DetectedObject>& objects) {
    return likely_per_sure * above(beyond_doubt, objects) >= above(likely, objects);
}

double share_of_buildings(std::span<const double> ratios) {
    double share = usual_share;
    for (int step = 0; step < most_steps; ++step) {
        double sum = usual_candidates * usual_share;
        for (const double ratio : ratios)
            sum += posterior(ratio, share);
        const double next = sum / (usual_candidates + static_cast<double>(ratios.size()));
        if (std::abs(next - share) < small_step)
            return next;
        share = next;
    }
    return share;
}

SupposedShare correct_for_place(double filled, std::vector<DetectedObject>& objects) {
    std::vector<double> ratios;
    for (const DetectedObject& object : objects)
        if (is_candidate(object))
            ratios.push_back(ratio_of(object));
    const bool as_elsewhere = looks_as_elsewhere(objects);
    if (filled > most_filled || ratios.size() < fewest_candidates || !as_elsewhere)
        return not_corrected(objects, as_elsewhere);
    const double share = share_of_buildings(ratios);
    if (share >= usual_share)
        return not_corrected(objects, as_elsewhere);
    for (DetectedObject& object : objects)
        if (is_candidate(object))
            object.confidence = posterior(ratio_of(object), share);
    return {share, share, as_elsewhere};
}

}  // namespace d2b
