#pragma once

#include <vector>

#include "detect/judged_objects.hpp"
#include "detect/place_prior.hpp"
#include "detect/regions.hpp"

namespace d2b {

/// Makes confidences those of their surroundings: houses stand among houses, and what passes for one in a
/// wood stands among crowns. The share of buildings around a candidate is the mean confidence of the others
/// within 150 m, the near ones the most, and of one more with the share that confidences suppose already;
/// by Bayes' rule the odds of a candidate change as those of the share do. That is done once: in further
/// rounds neighbours would convince each other of what one of them supposed.
/// @param regions whose objects they are, by label - 1
/// @param supposed see correct_for_place(); where it is a range, a share within it changes nothing
/// The sums of a candidate are made in the order of rows of 150 m, so they do not depend on threads.
void correct_for_neighbours(const Regions& regions, const CellSize& cell, const SupposedShare& supposed,
                            std::vector<DetectedObject>& objects, Executor& threads);

/// The same for objects that are no neighbours of each other, nor of the witnesses around them.
/// @param witnesses other objects of the same scene, with what is thought of them before their own
/// surroundings are looked at
void correct_for_witnesses(const JudgedObjects& witnesses, const CellSize& cell,
                           const SupposedShare& supposed, JudgedObjects& judged, Executor& threads);

}  // namespace d2b
