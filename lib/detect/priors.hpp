#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/executor.hpp"
#include "detect/detection.hpp"
#include "raster/regions.hpp"

namespace d2b::detect {

/// Odds of a probability, finite even for 1.
[[nodiscard]] inline double odds(double probability) {
    constexpr double least_doubt = 1e-15;
    return probability / std::max(1 - probability, least_doubt);
}

[[nodiscard]] inline double probability_of(double odds) {
    return odds / (1 + odds);
}

/// Lowers the log-odds of a probability.
[[nodiscard]] inline double less_sure(double probability, double log_odds) {
    return probability_of(odds(probability) * std::exp(-log_odds));
}

/// Estimates the share of buildings among the candidates of a scene. Confidences are only valid for the share
/// in the training data of classify(); wooded scenes have fewer buildings.
///
/// Expectation maximisation on the candidates' own likelihood ratios, without labels: M. Saerens, P. Latinne,
/// C. Decaestecker: Adjusting the Outputs of a Classifier to New a Priori Probabilities, Neural Computation
/// 14 (2002) 21-41. Pseudo-candidates with the usual share are added, so that small samples change little.
/// @param ratios likelihood ratio of each candidate (building to other objects), above 0
/// @param added number of pseudo-candidates
[[nodiscard]] double estimate_building_share(std::span<const double> ratios, double added = 50);

/// True if an object is ambiguous. Confidences of 0 and 1 are kept in every scene.
[[nodiscard]] bool is_ambiguous(const DetectedObject& object);

/// True if certain buildings have the usual appearance: at least a fifth of the objects with a confidence
/// above 0.5 have more than 0.95. Sparse points and blur prevent that for small houses.
[[nodiscard]] bool has_usual_appearance(const std::vector<DetectedObject>& objects);

/// True if the scene has no building that is clearly recognisable: fewer than a tenth of the objects with a
/// confidence above 0.5 have more than 0.9, not counting a single one that may be chance. Isolated trees and
/// bushes in fields are small and low, so a few of many resemble small houses, but none does so clearly.
[[nodiscard]] bool lacks_certain_buildings(const std::vector<DetectedObject>& objects);

/// Range of prior shares implied by the confidences.
struct PriorShare {
    double least = 0;
    double most = 1;
    bool usual_appearance = true;  ///< has_usual_appearance() of the objects before their correction
};

/// Corrects confidences for the share of buildings in the scene, see estimate_building_share(). That assumes
/// that buildings have the usual appearance, so it is only done if has_usual_appearance(), at most a tenth of
/// the cells was filled, and there are at least a hundred candidates. Otherwise the estimate is unreliable
/// and confidences do not change, unless lacks_certain_buildings(): then they are corrected for 2.5 times the
/// estimated share if that is less than the usual one. Confidences of 0 and 1 never change. Sums follow the
/// order of the objects.
/// @param filled see SurfaceQuality
/// @return range of shares that the new confidences imply: the share they were corrected for, or the range
/// between the usual share (or 2.5 times the estimated one) and their own mean
PriorShare apply_scene_prior(double filled, std::vector<DetectedObject>& objects);

/// Corrects confidences for the local share of buildings, because houses stand among houses, and crowns
/// mistaken for houses stand among crowns. The share around a candidate is the mean confidence of the others
/// within 150 m, weighted by proximity, and of a pseudo-candidate with the share already implied; by Bayes'
/// rule the odds of a candidate change as those of the share do. Applied once, because further rounds would
/// let neighbours reinforce each other's errors.
/// Sums of a candidate follow rows of 150 m, so that they do not depend on threads.
/// @param regions regions of the objects, by label - 1
/// @param prior see apply_scene_prior(); shares within this range change nothing
void apply_spatial_prior(const Regions& regions, const CellSize& cell, const PriorShare& prior,
                         std::vector<DetectedObject>& objects, Executor& threads);

}  // namespace d2b::detect
