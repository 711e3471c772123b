#pragma once

#include <cstddef>
#include <span>

#include "detect/judged_objects.hpp"

namespace d2b {

/// Combines the candidates of several passes over a scene. Each pass has wider thresholds than the one
/// before, so its objects (nearly) contain those of the previous pass. Selects from these trees the
/// non-overlapping objects with the largest sum of log-odds times cells, see best_nested().
/// @param looks passes, the strictest first
/// @param usual index of the regular pass; its objects are kept if they touch no selected object, because
/// they may still be doubtful
/// @return objects that share no edge. Selected objects that touch are merged, and inherit the classification
/// of the largest one. Objects rejected by the regular pass remain rejected unless a selected object covers
/// them.
[[nodiscard]] JudgedObjects best_of_looks(std::span<const JudgedObjects> looks, std::size_t usual,
                                          Executor& threads);

}  // namespace d2b
