#pragma once

#include <vector>

#include "detect/judged_objects.hpp"
#include "detect/place_prior.hpp"
#include "detect/regions.hpp"

namespace d2b {

/// Corrects confidences for the local share of buildings, because houses stand among houses, and crowns
/// mistaken for houses stand among crowns. The share around a candidate is the mean confidence of the others
/// within 150 m, weighted by proximity, and of a pseudo-candidate with the share already implied; by Bayes'
/// rule the odds of a candidate change as those of the share do. Applied once, because further rounds would
/// let neighbours reinforce each other's errors.
/// Sums of a candidate follow rows of 150 m, so that they do not depend on threads.
/// @param regions regions of the objects, by label - 1
/// @param supposed see correct_for_place(); shares within this range change nothing
void correct_for_neighbours(const Regions& regions, const CellSize& cell, const SupposedShare& supposed,
                            std::vector<DetectedObject>& objects, Executor& threads);

/// Same, for objects that must not influence each other or the reference objects.
/// @param witnesses reference objects of the same scene, with confidences before their own spatial correction
void correct_for_witnesses(const JudgedObjects& witnesses, const CellSize& cell,
                           const SupposedShare& supposed, JudgedObjects& judged, Executor& threads);

}  // namespace d2b
