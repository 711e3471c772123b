#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "detect/candidates.hpp"

namespace d2b::detect {

/// Node of a forest of nested candidates.
struct NestedCandidate {
    static constexpr std::size_t nothing = static_cast<std::size_t>(-1);

    double gain = 0;               ///< gain if chosen; only positive gains are ever chosen
    std::size_t parent = nothing;  ///< index of its parent, which comes after it
};

/// Finds a maximum-weight antichain of a forest: chooses candidates so that none contains another and the sum
/// of their gains is largest. Dynamic programming from the leaves up: a candidate is chosen if it gains more
/// than the best choice inside it; the inner ones win ties. Sums follow the order of the candidates.
/// @param candidates each before its parent
/// @return one flag per candidate
[[nodiscard]] std::vector<bool> max_weight_antichain(std::span<const NestedCandidate> candidates);

/// Combines the candidates of several passes over a scene. Each pass has wider thresholds than the one
/// before, so its objects (nearly) contain those of the previous pass. Selects from these trees the
/// non-overlapping objects with the largest sum of log-odds times cells, see max_weight_antichain().
/// @param passes passes, the strictest first
/// @param usual index of the regular pass; its objects are kept if they touch no selected object, because
/// they may still be doubtful
/// @return objects that share no edge. Selected objects that touch are merged, and inherit the classification
/// of the largest one. Objects rejected by the regular pass remain rejected unless a selected object covers
/// them.
[[nodiscard]] Candidates select_candidates(std::span<const Candidates> passes, std::size_t usual,
                                           Executor& threads);

/// Repeats the detection with 0.5, 0.7 and 1.4 times the usual thresholds of smoothness, and selects the best
/// candidates, see select_candidates(). Stricter thresholds separate crowns from houses, wider ones keep a
/// rough house in one piece. Where has_very_sparse_points(), the widest thresholds have three times the
/// margin for sparse points, and only apply beside the objects of the regular pass, because they merge houses
/// with adjacent crowns. Candidates found by wider thresholds are less often buildings, so their confidence
/// is lowered.
/// @param cells cells of the scene; changed
/// @param quality quality used by the regular pass
/// @param usual candidates of the regular pass
/// @return objects that share no edge. Halo: objects at the widest thresholds, the segments they meet, and 11
/// m and four cells around them.
[[nodiscard]] Candidates multi_threshold_candidates(const Scene& scene, SceneCells& cells, double min_area_m2,
                                                    const SurfaceQuality& quality, Candidates usual,
                                                    Executor& threads);

/// Clears the cells of regions and those at their sides.
void clear_with_border(const Regions& regions, Mask& cells, Executor& threads);

/// Merges sets of objects that share no edge, in scan order. Those that the first one has rejected remain
/// rejected unless an object covers them.
[[nodiscard]] Candidates merge_candidates(std::span<const Candidates> passes, Executor& threads);

}  // namespace d2b::detect
