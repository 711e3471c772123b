#pragma once

#include <span>
#include <vector>

#include "detect/detection.hpp"

namespace d2b {

/// Estimates the share of buildings among the candidates of a scene. Confidences are only valid for the share
/// in the training data of judge(); wooded scenes have fewer buildings.
///
/// Expectation maximisation on the candidates' own likelihood ratios, without labels: M. Saerens, P. Latinne,
/// C. Decaestecker: Adjusting the Outputs of a Classifier to New a Priori Probabilities, Neural Computation
/// 14 (2002) 21-41. Pseudo-candidates with the usual share are added, so that small samples change little.
/// @param ratios likelihood ratio of each candidate (building to other objects), above 0
/// @param added number of pseudo-candidates
[[nodiscard]] double share_of_buildings(std::span<const double> ratios, double added = 50);

/// True if an object is ambiguous. Confidences of 0 and 1 are kept in every scene.
[[nodiscard]] bool is_candidate(const DetectedObject& object);

/// True if certain buildings have the usual appearance: at least a fifth of the objects with a confidence
/// above 0.5 have more than 0.95. Sparse points and blur prevent that for small houses.
[[nodiscard]] bool looks_as_elsewhere(const std::vector<DetectedObject>& objects);

/// True if the scene has no building that is clearly recognisable: fewer than a tenth of the objects with a
/// confidence above 0.5 have more than 0.9, not counting a single one that may be chance. Isolated trees and
/// bushes in fields are small and low, so a few of many resemble small houses, but none does so clearly.
[[nodiscard]] bool hardly_any_is_sure(const std::vector<DetectedObject>& objects);

/// Range of prior shares implied by the confidences.
struct SupposedShare {
    double least = 0;
    double most = 1;
    bool as_elsewhere = true;  ///< looks_as_elsewhere() of the objects before their correction
};

/// Corrects confidences for the share of buildings in the scene, see share_of_buildings(). That assumes that
/// buildings have the usual appearance, so it is only done if looks_as_elsewhere(), at most a tenth of the
/// cells was filled, and there are at least a hundred candidates. Otherwise the estimate is unreliable and
/// confidences do not change, unless hardly_any_is_sure(): then they are corrected for 2.5 times the
/// estimated share if that is less than the usual one. Confidences of 0 and 1 never change. Sums follow the
/// order of the objects.
/// @param filled see SurfaceQuality
/// @param others objects that do not contribute to the estimate, but are corrected for 2.5 times it
/// @return range of shares that the new confidences imply: the share they were corrected for, or the range
/// between the usual share (or 2.5 times the estimated one) and their own mean
SupposedShare correct_for_place(double filled, std::vector<DetectedObject>& objects,
                                std::span<DetectedObject> others = {});

}  // namespace d2b
