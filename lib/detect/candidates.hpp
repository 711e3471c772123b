#pragma once

#include <optional>
#include <vector>

#include "core/executor.hpp"
#include "detect/detection.hpp"
#include "detect/object_features.hpp"
#include "detect/scene.hpp"
#include "detect/smoothness.hpp"
#include "raster/regions.hpp"

namespace d2b::detect {

constexpr double smallest_hole_m2 = 10;  ///< smaller holes of objects are filled

/// Grows objects by the rings of cells that an opening took off round corners. On cells up to 1.5 m, those do
/// not grow back that stand more than 1.2 m above all cells of objects within three cells, because they
/// belong to a crown beside the roof. Coarser cells hold a crown and a roof at once.
/// @param elevated cells that may belong to objects
[[nodiscard]] Mask grow_border(const Scene& scene, Mask objects, const Mask& elevated, Executor& threads);

/// Removes border cells that are less than half as high as the inner cells within two cells. A wall crosses
/// them, and in a blurred raster it stands at the points of half its height. Objects without inner cells keep
/// their border.
/// @param cells cells of objects; changed
void remove_blurred_edge(const Scene& scene, Mask& cells, Executor& threads);

/// Candidate objects with their features and classification.
struct Candidates {
    Regions regions;
    std::vector<DetectedObject> objects;   ///< by label - 1
    std::vector<ObjectFeatures> features;  ///< features by label - 1
    RejectedObjects rejected;
};

/// Properties of cells that do not depend on objects. Reused by later passes over a scene.
struct SceneCells {
    Mask elevated;
    std::vector<std::uint8_t> tall_rows;         ///< 1 for rows with cells taller than trees
    Grid<std::uint8_t> flags;                    ///< result of smoothness() ...
    std::optional<SmoothnessThresholds> limits;  ///< ... with these limits; nullopt if not computed yet
};
[[nodiscard]] SceneCells scene_cells(const Scene& scene, const DetectOptions& options, Executor& threads);

/// Estimates the noise of the surface and the share of filled cells, before any detection.
[[nodiscard]] SurfaceQuality surface_quality(const Scene& scene, SceneCells& cells, Executor& threads);

/// Computes the flags of smoothness for a quality unless they are up to date.
void flag_cells(const Scene& scene, const SurfaceQuality& quality, SceneCells& cells, Executor& threads);

/// Objects with crowns that touch their walls.
struct ObjectsWithCrowns {
    Candidates objects;
    Mask cells;  ///< of the objects
    SmoothSegments segments;
};

/// Finds elevated objects with smooth segments and classifies them.
/// @param cells cells of the scene; their flags are updated for the quality
/// @param min_area_m2 smaller objects are dropped
[[nodiscard]] ObjectsWithCrowns find_objects(const Scene& scene, SceneCells& cells, double min_area_m2,
                                             const SurfaceQuality& quality, Executor& threads);

/// Cuts off crowns that touch walls, see remove_attached_crowns().
/// @param flags with which the objects were found
[[nodiscard]] Candidates cut_crowns(const Scene& scene, const Grid<std::uint8_t>& flags, double min_area_m2,
                                    ObjectsWithCrowns found, Executor& threads);

/// Finds elevated objects without the crowns that touch their walls.
[[nodiscard]] Candidates find_candidates(const Scene& scene, SceneCells& cells, double min_area_m2,
                                         const SurfaceQuality& quality, Executor& threads);

}  // namespace d2b::detect
