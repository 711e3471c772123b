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

/// Stages, in the order of processing.
enum class Stage { read, ground, detect, levels, trace, filter, outline, roofs, attributes, surface, write };
inline constexpr std::array<std::string_view, 11> stage_names{"read",       "ground",  "detect",  "levels",
                                                              "trace",      "filter",  "outline", "roofs",
                                                              "attributes", "surface", "write"};

/// Reason why an object is not in the result, or not in its traced form.
enum class Reason {
    threshold_not_above_minimum,  ///< every point, or all but the lowest, exceed the threshold
    threshold_not_below_maximum,  ///< nothing exceeds the threshold
    threshold_repeated,
    contour_short,                ///< fewer grid points than the noise factor
    contour_small,                ///< less than the smallest area
    contour_on_dropped,           ///< stands on a contour that was dropped
    hole_short,                   ///< filled: fewer grid points than the noise factor
    hole_small,                   ///< filled: less than the smallest area
    outline_kept_traced,          ///< straight walls or simplification would have broken the polygon
    polygon_repaired,             ///< invalid according to GEOS
    polygon_lost,                 ///< nothing left after repair, so it is not written
    building_doubtful,            ///< its confidence is too low
    building_small,               ///< possible building that covers less than the smallest area
    building_low,                 ///< possible roof that is not above the smallest height
    crown_cut,                    ///< a tree crown touching a wall was cut off there
    crown_cells,                  ///< cells of such crowns
    building_not_tall,            ///< its p90 is below the smallest height of a building
    elevation_outside_range,      ///< not an elevation: outside of the range on land, or of -zrange
    elevation_undeclared_nodata,  ///< not an elevation: shared by many cells along the edge, a step from all
                                  ///< others
    elevation_blended,            ///< not an elevation: blended with NoData beside it by resampling
    elevation_spike,              ///< not an elevation: far above all its surroundings
    roof_spike,                   ///< above all its surroundings, so not the height of a building
    terrain_outside_range,        ///< not an elevation of the terrain model
    outline_split,                ///< split by the projection to the output's CRS, so it is not written
    surface_notch_filled,         ///< a building of the surface touched itself in an edge
    surface_corner_cut,           ///< buildings of the surface touched in an edge
    surface_lost,                 ///< no closed surface was found for the building
    surface_face_level,           ///< a face of a roof in the surface would reach below the ground
    surface_roof_tiers,           ///< the surface has tiers of the building instead of the planes of its roof
    flow_changed,                 ///< a wall, gap or corner unsuitable for flow solvers was repaired
    flow_unchanged,               ///< a wall, gap or corner unsuitable for flow solvers was left
    roof_face_doubtful,           ///< no plane suits a face of a roof, or it is too narrow for a slope
    part_merged,        ///< cut off by parcels, but too small or narrow, so merged with its neighbour
    building_excluded,  ///< half of it lies in polygons of objects that are not buildings
    building_denied,    ///< an editor has decided that it is not a building
};
inline constexpr std::array<std::string_view, 35> reason_names{"threshold_not_above_minimum",
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
                                                               "elevation_undeclared_nodata",
                                                               "elevation_blended",
                                                               "elevation_spike",
                                                               "roof_spike",
                                                               "terrain_outside_range",
                                                               "outline_split",
                                                               "surface_notch_filled",
                                                               "surface_corner_cut",
                                                               "surface_lost",
                                                               "surface_face_level",
                                                               "surface_roof_tiers",
                                                               "flow_changed",
                                                               "flow_unchanged",
                                                               "roof_face_doubtful",
                                                               "part_merged",
                                                               "building_excluded",
                                                               "building_denied"};

struct LevelReport {
    int level = 0;
    double threshold = 0;
    std::int64_t contours = 0;
    std::int64_t points = 0;
};

/// Length of the outlines of a layer in metres, by origin.
struct OutlineLength {
    double fitted = 0;  ///< straight walls and circular arcs
    double simplified = 0;
    double traced = 0;  ///< borders of cells

    [[nodiscard]] double whole() const { return fitted + simplified + traced; }
    [[nodiscard]] double traced_share() const { return traced > 0 ? traced / whole() : 0; }
    [[nodiscard]] double share_without_walls() const {
        return whole() > 0 ? (simplified + traced) / whole() : 0;
    }
};

struct UnitReport {
    std::string horizontal;  ///< name of the unit, "degree", or "unknown"
    std::string horizontal_source;
    double horizontal_metres = 1;  ///< metres in one unit; 0 for degrees
    std::string vertical;
    std::string vertical_source;
    double vertical_metres = 1;
    std::string areas;              ///< "geodesic" or "planar"
    bool vertical_is_known = true;  ///< false if metres were assumed for lack of information
};

/// Faces of roofs that were written, by kind.
struct RoofReport {
    std::int64_t flat = 0;
    std::int64_t pitched = 0;
    std::int64_t doubtful = 0;
    double area_m2 = 0;           ///< of all faces in plan
    double doubtful_area_m2 = 0;  ///< of those that are doubtful
    bool level = false;           ///< all faces are level, because walls are blurred

    [[nodiscard]] std::int64_t faces() const { return flat + pitched + doubtful; }
};

/// Statistics of the surface of the buildings.
struct SurfaceReport {
    std::array<double, 3> origin{};  ///< local origin: x, y and z in metres
    std::int64_t buildings = 0;
    std::int64_t blocks = 0;     ///< blocks of touching buildings; 0 if no format has them
    std::int64_t points = 0;     ///< points of the shell; 0 if no format has one
    std::int64_t triangles = 0;  ///< triangles of the shell; 0 if no format has one
};

/// Stack truncated at a level.
struct CutStack {
    std::int32_t level = 0;
    /// Error of its surface against the points of all buildings. The surface at a point is the mean of the
    /// points of its highest remaining contour outside that contour's children.
    double rmse_m = 0;
};

/// Estimated displacement of parcels relative to the raster.
struct ParcelMove {
    double right_m = 0;  ///< along rows, to higher columns
    double down_m = 0;   ///< towards higher rows
};

/// Statistics of buildings cut by parcels.
struct ParcelReport {
    double cut_length_m = 0;        ///< approximate length of cuts, before narrow parts are merged back
    double near_wall_length_m = 0;  ///< length of cuts with a wall within 4 m
    double median_distance_m =
        0;  ///< median distance between a cut and its nearby wall; NaN if there is none
    std::optional<ParcelMove> best_offset;  ///< displacement that fits walls best; nothing if undetermined
    double building_m2 = 0;                 ///< area of all buildings
    double inside_m2 = 0;                   ///< building area in parcels
    double overlap_m2 = 0;                  ///< building area in more than one parcel
    double invalid_m2 = 0;                  ///< building area in invalid parcels
};

/// Existing footprints that got heights.
struct FootprintReport {
    std::int64_t given = 0;            ///< features of their layer, all of which are written
    std::int64_t measured = 0;         ///< with at least one valid elevation
    std::int64_t outside = 0;          ///< beyond the used part of the raster
    std::int64_t without_cell = 0;     ///< inside, but without the centre of a cell
    std::int64_t without_data = 0;     ///< with cells, none of which is valid
    std::int64_t without_polygon = 0;  ///< features without a polygon
    std::int64_t invalid = 0;          ///< measured on a repaired copy
    std::int64_t flat = 0;             ///< measured, less than a tenth of which rises by -min_height
    std::int64_t missing = 0;          ///< buildings found of which footprints cover less than half
};

/// Corrections of an editor.
struct CorrectionReport {
    std::int64_t building = 0;        ///< corrections of this kind, with or without an effect
    std::int64_t no_building = 0;     ///< likewise
    std::int64_t cut = 0;             ///< likewise
    std::int64_t outside = 0;         ///< those beyond the used part of the raster
    std::int64_t without_effect = 0;  ///< those inside that have changed nothing
    std::int64_t unusable = 0;        ///< features of another kind, or with a geometry that does not suit it
};

/// Resolution of the raster, estimated from its own values.
struct SamplingReport {
    double interpolated_fraction =
        0;  ///< share of cells without a point of their own, which have a neighbour's height
    std::optional<double> points_per_cell;   ///< nothing if too many to estimate
    std::optional<double> edge_width_cells;  ///< distance over which a wall falls from nine tenths of its
                                             ///< height to one tenth; nothing if there are too few walls
    std::optional<double> value_step;        ///< rounding step of elevations, in the raster's vertical unit;
                                             ///< nothing if they were not rounded
};

/// Counters of stages, one per thread, merged afterwards.
struct Tally {
    std::array<std::int64_t, reason_names.size()> dropped{};
    std::array<double, stage_names.size()> seconds{};  ///< sum over all threads
    std::array<std::int64_t, stage_names.size()>
        peak_memory_bytes{};  ///< peak of the process at the end of the stage

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

/// Report of a run as data, for tools to print and tests to read.
struct RunReport : Tally {
    std::string input;
    std::string driver;
    std::string output;
    std::string crs;
    std::string output_crs;
    Layers layers = Layers::both;  ///< those written
    UnitReport units;
    std::int64_t rows = 0;
    std::int64_t cols = 0;
    std::int64_t points = 0;  ///< rows * cols
    std::int64_t valid_points = 0;
    double minimum = 0;
    double maximum = 0;
    double mean = 0;
    double standard_deviation = 0;
    std::vector<LevelReport> levels;  ///< level 0 first
    std::int64_t contours = 0;        ///< number written
    std::int64_t buildings = 0;       ///< number written
    std::int64_t doubtful = 0;        ///< number written
    std::int64_t uncertain = 0;       ///< buildings written whose confidence is below 0.9
    std::int64_t uneven = 0;          ///< buildings written whose p90 is more than 5 m above their p50
    double buildings_m2 = 0;          ///< area of the buildings written
    double uneven_m2 = 0;             ///< area of the uneven ones
    /// Error of the stacked surface against the points of all buildings. The surface at a point is tier_z of
    /// the highest contour that contains it, as written, or as traced if contours are not written.
    double stack_rmse_m = 0;
    std::int64_t vertices = 0;  ///< vertices of the contours as written (of the buildings if only these are
                                ///< written), closing ones not counted
    OutlineLength building_outlines;  ///< lengths as written; 0 if the layer is not written
    OutlineLength contour_outlines;
    std::optional<RoofReport> roofs;              ///< if requested
    std::optional<SurfaceReport> surface;         ///< if requested
    std::vector<CutStack> cuts;                   ///< level 1 first; only if a sink gets the tiers of stacks
    std::optional<ParcelReport> parcels;          ///< if parcels cut buildings
    std::optional<FootprintReport> footprints;    ///< if existing footprints got heights
    std::optional<CorrectionReport> corrections;  ///< if there are any
    std::optional<SamplingReport> sampling;       ///< if buildings were detected
    int threads = 1;                              ///< number used
    std::vector<std::string> warnings;
};

}  // namespace d2b
