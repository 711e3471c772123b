#pragma once

#include <optional>
#include <vector>

#include "detect/detection.hpp"
#include "detect/evidence.hpp"
#include "detect/regions.hpp"
#include "detect/smoothness.hpp"

namespace d2b {

/// Candidate objects with their features and classification.
struct JudgedObjects {
    Regions regions;
    std::vector<DetectedObject> objects;  ///< by label - 1
    std::vector<Evidence> evidence;       ///< features by label - 1
    LeftOut left_out;
};

/// Properties of cells that do not depend on objects. Reused by later passes over a scene.
struct SceneCells {
    Mask elevated;
    std::vector<std::uint8_t> tall_rows;  ///< 1 for rows with cells taller than trees
    Grid<std::uint8_t> flags;             ///< result of smoothness() ...
    std::optional<SmoothLimits> limits;   ///< ... with these limits; nullopt if not computed yet
};
[[nodiscard]] SceneCells scene_cells(const Scene& scene, const DetectOptions& options, Executor& threads);

/// Estimates the noise of the surface and the share of filled cells, before any detection.
[[nodiscard]] SurfaceQuality surface_quality(const Scene& scene, SceneCells& cells, Executor& threads);

/// Treatment of crowns that touch walls, see take_crowns_off().
enum class LeaningCrowns { are_cut_off, stay };

/// Finds elevated objects with smooth segments and classifies them.
/// @param cells cells of the scene; their flags are updated for the quality
/// @param smallest_m2 smaller objects are dropped
[[nodiscard]] JudgedObjects judged_objects(const Scene& scene, SceneCells& cells, double smallest_m2,
                                           const SurfaceQuality& quality, Executor& threads,
                                           LeaningCrowns crowns = LeaningCrowns::are_cut_off);

}  // namespace d2b
