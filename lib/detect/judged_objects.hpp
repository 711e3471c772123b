#pragma once

#include <optional>
#include <vector>

#include "detect/detection.hpp"
#include "detect/evidence.hpp"
#include "detect/regions.hpp"
#include "detect/smoothness.hpp"

namespace d2b {

/// Objects and what is thought of them.
struct JudgedObjects {
    Regions regions;
    std::vector<DetectedObject> objects;  ///< by label - 1
    std::vector<Evidence> evidence;       ///< what they were judged by, by label - 1
    LeftOut left_out;
};

/// What is known of each cell before objects are found. Kept from one look at a scene to the next.
struct SceneCells {
    Mask elevated;
    std::vector<std::uint8_t> tall_rows;  ///< 1 for rows with cells that are taller than trees
    Grid<std::uint8_t> flags;             ///< of smoothness() ...
    std::optional<SmoothLimits> limits;   ///< ... with these limits; none where they are not there yet
};
[[nodiscard]] SceneCells scene_cells(const Scene& scene, const DetectOptions& options, Executor& threads);

/// What can be said of the surface before anything is found on it: its noise, and how many cells were filled.
[[nodiscard]] SurfaceQuality surface_quality(const Scene& scene, SceneCells& cells, Executor& threads);

/// What becomes of crowns that lean on walls, see take_crowns_off().
enum class LeaningCrowns { are_cut_off, stay };

/// Finds what stands on the ground and has smooth pieces, and judges it.
/// @param cells of the scene; their flags become those that suit the quality
/// @param smallest_m2 what covers less is left out
[[nodiscard]] JudgedObjects judged_objects(const Scene& scene, SceneCells& cells, double smallest_m2,
                                           const SurfaceQuality& quality, Executor& threads,
                                           LeaningCrowns crowns = LeaningCrowns::are_cut_off);

}  // namespace d2b
