#pragma once

#include <string>
#include <vector>

#include "dem2buildings/options.hpp"

namespace d2b {

/// Default of -min_area for buildings.
inline constexpr double default_min_building_m2 = 30;

/// Default of -detail. Removes railings, dormers and branches over a roof, but keeps a storey.
inline constexpr double default_detail_m = 0.5;

/// Default of -regularize_tolerance: the distance at which a wall may cut off a bay or a corner that the data
/// round off. At least one and a half cells, because a slanted wall cannot fit its staircase within less.
inline constexpr double wall_tolerance_m = 2.5;
inline constexpr double min_wall_tolerance_cells = 1.5;

/// Area that a wall has to be worth: smaller details are not parts of a house.
inline constexpr double wall_price_m2 = 0.5;
inline constexpr double min_wall_price_cells = 1.25;

/// Returns true for Preset::buildings. Preset::thesis takes everything above its thresholds.
[[nodiscard]] inline bool detects_buildings(const Options& options) {
    return options.preset == Preset::buildings;
}

/// Returns -detail or its default, in m.
[[nodiscard]] double detail_of(const Options& options);

/// Decided options of a run: the given ones, and values for those left open.
struct RunPlan {
    Options asked;
    GroundMode ground;
    LevelSource levels;
    double detail;  ///< m
    TraceMode trace;
    Walls walls;
    double building_m2;  ///< smallest area of a building
    double contour_m2;   ///< smallest area of a contour
    Layers layers;
    SurfaceOf surface_of;

    [[nodiscard]] bool detects_buildings() const { return d2b::detects_buildings(asked); }
    /// Returns true if the planes of roofs of found buildings are written in a layer or a surface. With given
    /// footprints only these have roofs.
    [[nodiscard]] bool needs_roofs() const {
        return !asked.write.has_footprints() &&
               (asked.write.roofs || (surface_of == SurfaceOf::roofs && !asked.write.surfaces.empty()));
    }
    /// Returns the tolerance in cells. @param cell_m side of a cell in metres; 0 if unknown
    [[nodiscard]] double wall_tolerance(double cell_m) const;
    /// Returns the area in cells that a wall has to be worth. @param cell_m side of a cell in metres; 0 if
    /// unknown
    [[nodiscard]] static double wall_price(double cell_m);
    /// Returns the options with all decisions filled in, except those that depend on the cell size.
    [[nodiscard]] Options resolved() const;
};

/// Decides options that were left open:
///
///                     buildings                    thesis
///       -ground       auto                         none
///       -levels       natural                      global
///       -detail       0.5 m                        0
///       -trace        cells                        points
///       -regularize   auto, off if simplified      off
///       -min_area     30 m2, of buildings          0, of all contours
///       -surface_of   buildings                    contours
///
/// @param options already accepted by check_options() @param layers that the destination gets
/// @throws OptionError if an option concerns a layer that the destination does not get
[[nodiscard]] RunPlan make_run_plan(Options options, Layers layers);

/// Returns the names of rasters, surfaces and the page written besides the layers; "" for those not
/// requested.
[[nodiscard]] inline std::vector<std::string> auxiliary_file_names(const WriteOptions& write) {
    std::vector<std::string> names{write.ground, write.height, write.canopy};
    names.push_back(write.page);
    names.insert(names.end(), write.surfaces.begin(), write.surfaces.end());
    return names;
}

}  // namespace d2b
