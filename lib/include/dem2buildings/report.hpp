#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/options.hpp"

namespace d2b {

/// The stages, in the order in which they run.
enum class Stage { read, ground, detect, levels, trace, filter, outline, attributes, surface, write };
inline constexpr std::array<std::string_view, 10> stage_names{
    "read", "ground", "detect", "levels", "trace", "filter", "outline", "attributes", "surface", "write"};

/// Why something that was found is not in the result, or not in its traced form.
enum class Reason {
    threshold_not_above_minimum,  ///< a threshold that every point or all but the lowest exceed
    threshold_not_below_maximum,  ///< a threshold that nothing exceeds
    threshold_repeated,
    contour_short,               ///< fewer grid points than the noise factor
    contour_small,               ///< less than the smallest area
    contour_on_dropped,          ///< stands on a contour that was dropped
    hole_short,                  ///< filled: fewer grid points than the noise factor
    hole_small,                  ///< filled: less than the smallest area
    outline_kept_traced,         ///< straight walls or simplification would have broken the polygon
    polygon_repaired,            ///< GEOS called it invalid
    polygon_lost,                ///< nothing of it was left to repair: it is not written
    building_doubtful,           ///< its confidence is too low
    building_small,              ///< what may be a building, but covers less than the smallest area
    building_low,                ///< what may be a roof, but is not above the smallest height
    crown_cut,                   ///< a crown that leaned on a wall, cut off there
    crown_cells,                 ///< cells of such crowns
    building_not_tall,           ///< its p90 is below the smallest height of a building
    elevation_outside_range,     ///< no elevation: outside of what occurs on land, or of -zrange
    elevation_undeclared,        ///< no elevation: what many cells along the edge share, a step from all else
    elevation_above_neighbours,  ///< no elevation: far above all around it
    elevation_not_roof,          ///< above all around it: not the height of a building
    terrain_outside_range,       ///< no elevation of the terrain model
    outline_torn,                ///< the CRS of the output tears it apart: it is not written
    surface_notch_filled,        ///< a building of the surface touched itself in an edge
    surface_corner_cut,          ///< buildings of the surface touched in an edge
    surface_lost,                ///< a building that no closed surface was found for
    flow_changed,                ///< a wall, gap or corner that a flow solver cannot take, mended
    flow_left,                   ///< the same, left as it is
    part_merged,                 ///< cut off by parcels, but too small or narrow: with its neighbour
};
inline constexpr std::array<std::string_view, 29> reason_names{"threshold_not_above_minimum",
                                                               "threshold_not_below_maximum",
                                                               "threshold_repeated",
                                                               "contour_short",
                                                               "contour_small",
                                                               "contour_on_dropped",
                                                               "hole_short",
                                                               "hole_small",
                                                               "outline_kept_traced",
                                                               "polygon_repaired",
                                                               "polygon_lost",
                                                               "building_doubtful",
                                                               "building_small",
                                                               "building_low",
                                                               "crown_cut",
                                                               "crown_cells",
                                                               "building_not_tall",
                                                               "elevation_outside_range",
                                                               "elevation_undeclared",
                                                               "elevation_above_neighbours",
                                                               "elevation_not_roof",
                                                               "terrain_outside_range",
                                                               "outline_torn",
                                                               "surface_notch_filled",
                                                               "surface_corner_cut",
                                                               "surface_lost",
                                                               "flow_changed",
                                                               "flow_left",
                                                               "part_merged"};

struct LevelReport {
    int level = 0;
    double threshold = 0;
    std::int64_t contours = 0;
    std::int64_t points = 0;
};

/// Length of the outlines of a layer, in metres, by what they are made of.
struct OutlineLength {
    double fitted = 0;  ///< straight walls and circular arcs
    double simplified = 0;
    double traced = 0;  ///< borders of cells

    [[nodiscard]] double whole() const { return fitted + simplified + traced; }
    [[nodiscard]] double traced_share() const { return traced > 0 ? traced / whole() : 0; }
};

struct UnitReport {
    std::string horizontal;  ///< name of the unit, "degree", or "unknown"
    std::string horizontal_decided_by;
    double horizontal_metres = 1;  ///< metres in one unit; 0 for degrees
    std::string vertical;
    std::string vertical_decided_by;
    double vertical_metres = 1;
    std::string areas;              ///< "geodesic" or "planar"
    bool vertical_is_known = true;  ///< not taken for metres since nothing says what it is
};

/// The surface of the buildings.
struct SurfaceReport {
    std::array<double, 3> origin{};  ///< of local coordinates, x, y and z in metres
    std::int64_t buildings = 0;
    std::int64_t blocks = 0;     ///< of touching buildings; none where no format has them
    std::int64_t points = 0;     ///< of the shell; none likewise
    std::int64_t triangles = 0;  ///< likewise
};

/// A stack that ends at a level.
struct CutStack {
    std::int32_t level = 0;
    double rmse_m = 0;  ///< of its surface against the points of all buildings: at a point, the mean of those
                        ///< of its highest contour that no higher one of the cut stack holds
};

/// How parcels would have to be moved on the raster.
struct ParcelMove {
    double right_m = 0;  ///< along rows, to higher columns
    double down_m = 0;   ///< to higher rows
};

/// How parcels cut buildings.
struct ParcelReport {
    double cut_length_m = 0;       ///< of what they part before narrow parts go back, about
    double beside_length_m = 0;    ///< of this, what has a wall beside it, within 4 m
    double median_distance_m = 0;  ///< between a cut and the wall beside it; NaN where there is none
    std::optional<ParcelMove> fitting_move;  ///< to lie on walls best; nothing where that cannot be said
    double building_m2 = 0;                  ///< of all buildings
    double inside_m2 = 0;                    ///< of these, in parcels
    double several_m2 = 0;                   ///< of this, in more than one
    double invalid_m2 = 0;                   ///< of this, in parcels that are not valid
};

/// How finely the raster shows what stands on the ground, as estimated from itself.
struct SamplingReport {
    double filled_share = 0;  ///< of the cells, those that no point fell into and that have a neighbour's
                              ///< height
    std::optional<double> points_per_cell;   ///< nothing where they are too many to be told
    std::optional<double> step_width_cells;  ///< over which a wall falls from nine tenths of its height to
                                             ///< one; nothing where there are too few walls
    std::optional<double> value_step;        ///< that elevations were rounded to, in the raster's vertical
                                             ///< unit; nothing where they were not
};

/// What stages count. Threads that work at the same time have one each.
struct Tally {
    std::array<std::int64_t, reason_names.size()> dropped{};
    std::array<double, stage_names.size()> seconds{};  ///< of all threads together
    std::array<std::int64_t, stage_names.size()>
        peak_memory_bytes{};  ///< of the process, when the stage ended

    void count(Reason reason, std::int64_t n = 1) { dropped[static_cast<std::size_t>(reason)] += n; }
    [[nodiscard]] std::int64_t counted(Reason reason) const {
        return dropped[static_cast<std::size_t>(reason)];
    }
    void merge(const Tally& other) {
        for (std::size_t i = 0; i < dropped.size(); ++i)
            dropped[i] += other.dropped[i];
        for (std::size_t i = 0; i < seconds.size(); ++i) {
            seconds[i] += other.seconds[i];
            peak_memory_bytes[i] = std::max(peak_memory_bytes[i], other.peak_memory_bytes[i]);
        }
    }
};

/// What a run did, as data: the tools print it, tests read it.
struct RunReport : Tally {
    std::string input;
    std::string driver;
    std::string output;
    std::string crs;
    std::string output_crs;
    Layers layers = Layers::both;  ///< that were written
    UnitReport units;
    std::int64_t rows = 0;
    std::int64_t cols = 0;
    std::int64_t points = 0;  ///< rows * cols
    std::int64_t valid_points = 0;
    double minimum = 0;
    double maximum = 0;
    double mean = 0;
    double standard_deviation = 0;
    std::vector<LevelReport> levels;  ///< from level 0 up
    std::int64_t contours = 0;        ///< written
    std::int64_t buildings = 0;       ///< written
    std::int64_t doubtful = 0;        ///< written
    double stack_rmse_m = 0;    ///< of the stacked surface (at a point: tier_z of the highest contour that
                                ///< holds it, as written) against the points of all buildings; where no
                                ///< contours are written, of those as they were traced
    std::int64_t vertices = 0;  ///< of the contours as written (of the buildings where these are alone),
                                ///< closing ones not counted
    OutlineLength building_outlines;  ///< of the layers as written; nothing where one is not
    OutlineLength contour_outlines;
    std::optional<SurfaceReport> surface;    ///< where one was asked for
    std::vector<CutStack> cuts;              ///< from level 1 up, where a sink gets the tiers of stacks
    std::optional<ParcelReport> parcels;     ///< where buildings were cut by some
    std::optional<SamplingReport> sampling;  ///< where buildings were searched for
    int threads = 1;                         ///< that worked on it
    std::vector<std::string> warnings;
};

}  // namespace d2b
