#pragma once

#include "dem2buildings/options.hpp"

namespace d2b {

/// The smallest building where -min_area is not given.
inline constexpr double smallest_building_m2 = 30;

/// -detail where it is not given: rails, dormers and what trees hang over a roof go, a storey stays.
inline constexpr double usual_detail_m = 0.5;

/// How far a wall may leave its trace where -regularize_tolerance is not given: so many cells, but no more
/// metres, since coarse cells would let it come nearer to its neighbours than they are away; and at least a
/// cell, without which no slanted wall fits its staircase.
inline constexpr double wall_tolerance_cells = 1.5;
inline constexpr double least_wall_tolerance_cells = 1;
inline constexpr double wall_tolerance_m = 1.25;

/// Whether buildings are looked for: Preset::buildings. Preset::thesis takes everything above its thresholds.
[[nodiscard]] inline bool detects_buildings(const Options& options) {
    return options.preset == Preset::buildings;
}

/// -detail, or what stands for it where it is not given. m
[[nodiscard]] double detail_of(const Options& options);

/// What a run does: what was asked for, and what became of that which was left open.
struct RunPlan {
    Options asked;
    GroundMode ground;
    LevelSource levels;
    double detail;  ///< m
    TraceMode trace;
    Walls walls;
    double building_m2;  ///< smallest area of what is taken for a building
    double contour_m2;   ///< smallest area of a contour
    Layers layers;
    SurfaceOf surface_of;

    [[nodiscard]] bool detects_buildings() const { return d2b::detects_buildings(asked); }
    /// Cells. @param cell_m side of a cell in metres; 0 where it is not known
    [[nodiscard]] double wall_tolerance(double cell_m) const;
    /// The options with all that was left open filled in, but for what depends on the cells.
    [[nodiscard]] Options settled() const;
};

/// Decides what the options leave open:
///
///                 buildings                    thesis
///   -ground       auto                         none
///   -levels       natural                      global
///   -detail       0.5 m                        0
///   -trace        cells                        points
///   -regularize   auto, off if simplified      off
///   -min_area     30 m2, of buildings          0, of all contours
///   -surface_of   buildings                    contours
///
/// @param options as check_options() takes them @param layers what the destination gets
/// @throws OptionError where an option speaks of a layer that the destination does not get
[[nodiscard]] RunPlan make_run_plan(Options options, Layers layers);

}  // namespace d2b
