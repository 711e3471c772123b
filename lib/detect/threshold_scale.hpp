#pragma once

#include <optional>
#include <vector>

#include "detect/candidates.hpp"
#include "detect/scene.hpp"

namespace d2b::detect {

/// Sharpness of the steps at the borders of objects: the fall within one cell divided by the fall within
/// three. It is 1 for vertical walls, and a half or less if the raster is blurred, as in elevations from
/// satellite images or from a coarser raster. Returns 1 if nothing falls. Integer sums in mm, so the order
/// does not matter. Halo: three cells.
/// @param objects cells of objects
[[nodiscard]] double step_sharpness(const MetreGrid& surface, const Mask& objects, Executor& threads);

/// Copy of a square of a scene, with its certain roof cells.
struct RoofSample {
    MetreGrid surface;
    MetreGrid terrain;
    CellSize cell;
    std::optional<Mask> allowed;
    std::optional<MetreGrid> greenness;
    Mask roofs;

    [[nodiscard]] Scene scene() const {
        return {surface, terrain, cell, allowed ? &*allowed : nullptr, greenness ? &*greenness : nullptr};
    }
};

/// Copies the up to four squares of 1024 by 1024 cells with most roof cells; the first ones win ties. The
/// squares are tiles from the scene's first row and column.
[[nodiscard]] std::vector<RoofSample> roof_samples(const Scene& scene, const Mask& roofs, Executor& threads);

/// Estimates a scale of the smoothness thresholds below 1 for scenes with roofs smoother than usual, so that
/// crowns are excluded that the usual thresholds include.
///
/// Cells more than 1 m inside objects that are certainly buildings (confidence above 0.95) are roofs.
/// Stricter thresholds take cells away from all likely buildings: crowns at their walls and false objects,
/// but roofs as well. The gain of a scale is the share of cells that it takes away, less
/// price_of_lost_roofs() times the share of roofs that it loses; objects that are certainly buildings and are
/// mostly lost count against it. The scale is the strictest of those with nearly the largest gain. Only the
/// (up to) four squares of 1024 by 1024 cells with most roof cells are processed, so that the time does not
/// grow with the scene. Integer counts, so the order does not matter.
///
/// @param first candidates found with `quality`
/// @return 1 or one of stricter_scales(); nullopt if there are fewer than 500
/// such cells, without has_usual_appearance(), since certain roofs then do not speak for the others, with
/// has_sparse_slopes(), or if walls are blurred (step_sharpness() below 0.6), because blur smooths roofs and
/// crowns alike, and bends small houses
[[nodiscard]] std::optional<double> estimate_threshold_scale(const Scene& scene, const DetectOptions& options,
                                                             double min_area_m2,
                                                             const SurfaceQuality& quality,
                                                             const Candidates& first, Executor& threads);

}  // namespace d2b::detect
