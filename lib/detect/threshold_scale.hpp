#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "detect/candidates.hpp"
#include "detect/scene.hpp"

namespace d2b::detect {

/// Falls at the borders of objects. Integer sums in mm over all border cells, so the order does not matter.
struct StepFalls {
    std::int64_t within_near = 0;  ///< within one cell
    std::int64_t within_far = 0;   ///< within three cells

    void merge(const StepFalls& other) {
        within_near += other.within_near;
        within_far += other.within_far;
    }
    /// Share of the fall that happens within one cell. It is 1 for vertical walls or if nothing falls, and a
    /// half or less if the raster is blurred, as in elevations from satellite images or from a coarser
    /// raster.
    [[nodiscard]] double sharpness() const;
};
/// @param objects cells of objects. Halo: three cells
[[nodiscard]] StepFalls step_falls(const MetreGrid& surface, const Mask& objects, Executor& threads);

/// Copy of a square of a scene.
struct SceneSample {
    MetreGrid surface;
    MetreGrid terrain;
    CellSize cell;
    std::optional<Mask> allowed;
    std::optional<MetreGrid> greenness;

    [[nodiscard]] Scene scene() const {
        return {surface, terrain, cell, allowed ? &*allowed : nullptr, greenness ? &*greenness : nullptr};
    }
};

/// Copies the up to four squares of 1024 by 1024 cells with most cells of a mask; the first ones win ties.
/// The squares are tiles from the scene's first row and column.
[[nodiscard]] std::vector<SceneSample> scene_samples(const Scene& scene, const Mask& cells,
                                                     Executor& threads);

/// Estimates a scale of the smoothness thresholds below 1 for scenes with roofs smoother than usual, so that
/// crowns are excluded that the usual thresholds include.
///
/// Objects are found in samples of the scene, those with most smooth elevated cells, so that the time hardly
/// grows with the scene. Cells more than 1 m inside objects that are certainly buildings (confidence above
/// 0.95) are roofs. Stricter thresholds take cells away from all likely buildings: crowns at their walls and
/// false objects, but roofs as well. The gain of a scale is the share of cells that it takes away, less
/// price_of_lost_roofs() times the share of roofs that it loses; objects that are certainly buildings and are
/// mostly lost count against it. The scale is the strictest of those with nearly the largest gain. Integer
/// counts, so the order does not matter.
///
/// @param cells cells of the scene, with flags of the usual thresholds
/// @return one of stricter_scales(), or 1. Also 1 if there are fewer than 500 cells of roofs, without
/// has_usual_appearance(), since certain roofs then do not speak for the others, with has_sparse_slopes(), or
/// if walls are blurred (a sharpness below 0.6), because blur smooths roofs and crowns alike, and bends small
/// houses
[[nodiscard]] double estimate_threshold_scale(const Scene& scene, const SceneCells& cells,
                                              const DetectOptions& options, double min_area_m2,
                                              const SurfaceQuality& quality, Executor& threads);

}  // namespace d2b::detect
