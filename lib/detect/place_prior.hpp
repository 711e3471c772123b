#pragma once

#include <span>
#include <vector>

#include "detect/detection.hpp"

namespace d2b {

/// How many of the candidates of a place are buildings. A confidence holds where as many of them are as in
/// the places to which judge() was fitted; among woods fewer are.
///
/// The share is estimated by expectation and maximisation from the candidates' own likelihood ratios, without
/// any labels: M. Saerens, P. Latinne, C. Decaestecker: Adjusting the Outputs of a Classifier to New a Priori
/// Probabilities, Neural Computation 14 (2002) 21-41. Some candidates with the usual share are added, so
/// that few move it little.
/// @param ratios how much likelier each candidate is among buildings than among other things, above 0
/// @param added how many are added
[[nodiscard]] double share_of_buildings(std::span<const double> ratios, double added = 50);

/// Whether an object may or may not be a building: a confidence of 0 or 1 is kept, whatever the place.
[[nodiscard]] bool is_candidate(const DetectedObject& object);

/// Whether what is surely a building looks here as it does elsewhere: a fifth of the objects with a
/// confidence above 0.5 are beyond doubt (above 0.95). Thin points and blur undo that for small houses.
[[nodiscard]] bool looks_as_elsewhere(const std::vector<DetectedObject>& objects);

/// Whether a place has no building that shows as one: of the objects with a confidence above 0.5 fewer than a
/// tenth are above 0.9, where one that may be so by chance does not count. Single trees and bushes of fields
/// are small and low, and some of many look like small houses; none does so beyond doubt.
[[nodiscard]] bool hardly_any_is_sure(const std::vector<DetectedObject>& objects);

/// Shares of candidates that are buildings which confidences may suppose, the lowest and the highest.
struct SupposedShare {
    double least = 0;
    double most = 1;
    bool as_elsewhere = true;  ///< of the objects before they were corrected, see looks_as_elsewhere()
};

/// Makes confidences those of a place with its own share_of_buildings(). That supposes that buildings look
/// here as they do elsewhere, see looks_as_elsewhere(): it is done only where they do, where at most a tenth
/// of the cells was filled, and where there are at least a hundred candidates. Elsewhere the share may be
/// wrong, and confidences stay as they are, unless hardly_any_is_sure(): then they are those for 2.5 times
/// the share that is estimated, where that is less than the usual one. Confidences of 0 and 1 stay as they
/// are everywhere. Sums are made in the order of the objects.
/// @param filled see SurfaceQuality
/// @param others what is no sign of the share, but is corrected for 2.5 times it
/// @return what share they suppose then: the one they were corrected for, or one between the usual share, or
/// 2.5 times the estimated one, and their own mean
SupposedShare correct_for_place(double filled, std::vector<DetectedObject>& objects,
                                std::span<DetectedObject> others = {});

}  // namespace d2b
