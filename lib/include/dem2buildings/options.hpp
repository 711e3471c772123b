#pragma once

#include <array>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace d2b {

/// Options, one struct per stage. The only place that defines defaults. The option table
/// (options/option_table.hpp) adds name, unit, range and help. Set fields directly, or by name with
/// set_option().

struct ReadOptions {
    std::string source;  ///< anything that GDAL opens, a folder of rasters, or several rasters, one per line
    int band = 1;
    std::vector<std::string> open_options;                  ///< NAME=VALUE
    std::vector<std::string> drivers;                       ///< formats to try; all if empty
    std::string crs;                                        ///< overrides the file's
    std::optional<std::array<double, 4>> source_window;     ///< column, row, columns, rows
    std::optional<std::array<double, 4>> projected_window;  ///< ulx, uly, lrx, lry
    std::optional<std::array<double, 4>> extent;            ///< xmin, ymin, xmax, ymax
    std::string cutline;                                    ///< polygons that bound the area of interest
    std::string cutline_layer;                              ///< its layer; "": the first with geometries
    std::optional<double> nodata;                           ///< overrides the file's
    bool ignore_nodata = false;
    std::string vertical_unit;  ///< "m", "ft", "us-ft" or metres in a unit; detected if empty
    /// Lowest and highest valid elevation in the vertical unit; by default the range that occurs on land.
    std::optional<std::array<double, 2>> elevation_range;
};

/// Method: a set of defaults for options that are not given.
enum class Preset {
    buildings,  ///< finds ground and buildings, straightens walls
    thesis      ///< method of Chittineni (2003): everything above a threshold is a building
};

enum class GroundMode { automatic, given, none };

struct GroundOptions {
    std::optional<GroundMode> mode;
    std::string terrain;             ///< terrain model of GroundMode::given
    double max_building_width = 60;  ///< m: ground is searched beyond buildings up to this width
};

struct DetectOptions {
    double min_height = 2;           ///< m above ground
    double min_building_height = 0;  ///< m: drops buildings of which nine tenths are lower
    double min_confidence = 0.5;     ///< less certain objects are doubtful
    std::string mask;                ///< raster or polygons: restricts the search for buildings
    std::string mask_layer;          ///< layer of the polygons; "": the first with geometries
    std::string exclude;             ///< polygons of objects that are not buildings, such as bridges
    std::string exclude_layer;       ///< its layer; "": the first with geometries
    double exclude_buffer = 0;       ///< m: widens these polygons
    std::string corrections;         ///< an editor's decisions: points, polygons and lines
    std::string corrections_layer;   ///< its layer; "": all that have a field `kind`
    std::string ndvi;                ///< raster of the normalised difference vegetation index
    double split_height = 0;         ///< m: height step that divides buildings; 0: none
    std::string split_by;            ///< polygons or lines that cut buildings, such as parcels
    std::string split_layer;         ///< its layer; "": the first with geometries
    std::string split_field;         ///< identifies a polygon; "": the feature's id
    double split_width = 1.5;        ///< m: narrower parts are not cut off

    [[nodiscard]] bool is_split_by() const { return !split_by.empty(); }
};

enum class TraceMode { points, cells };

/// Range divided by -lod: the elevations of each building, in equal slices or at natural breaks, or of the
/// whole DEM, in equal slices.
enum class LevelSource { building, natural, global };

struct LevelOptions {
    std::optional<LevelSource> source;
    int lod = 4;                ///< slices of mean +- standard deviation; maximum number of natural breaks
    std::vector<double> fixed;  ///< explicit thresholds
    std::optional<double> interval;  ///< thresholds at offset + n * interval
    double offset = 0;
    /// m: height by which a strip one metre wide (a cell, if cells are larger) must stand out to be a tier;
    /// 0: no cleaning
    std::optional<double> detail;
};

struct TraceOptions {
    std::optional<TraceMode> mode;
};

struct FilterOptions {
    int noise_factor = 10;  ///< minimum number of grid points on a ring
    std::optional<double>
        min_area_m2;  ///< smallest area of a building, or of a contour if buildings are not detected
};

enum class Walls { automatic, off, right, free };

struct OutlineOptions {
    std::optional<Walls> walls;
    std::optional<double> wall_tolerance;  ///< cells: maximum distance between outline and trace
    double wall_inset = 0;                 ///< cells: moves straight walls inward, see -wall_inset
    bool arcs = false;                     ///< write recognised circular arcs
    double simplify = 0;                   ///< tolerance in units of the CRS; 0: keep every vertex
    bool disjoint = false;                 ///< bands that do not overlap
    std::string target_crs;                ///< "": the DEM's
    double flow_ready = 0;                 ///< m: shorter gaps and walls are changed; 0: none
    std::optional<double> min_gap;         ///< m: gaps only
    std::optional<double> min_wall;        ///< m: walls only

    [[nodiscard]] double narrowest_gap() const { return min_gap.value_or(flow_ready); }
    [[nodiscard]] double shortest_wall() const { return min_wall.value_or(flow_ready); }
    [[nodiscard]] bool is_flow_ready() const { return narrowest_gap() > 0 || shortest_wall() > 0; }
};

struct RoofOptions {
    double min_area_m2 = 4;  ///< smallest face
};

enum class Layers { both, buildings, contours };
enum class LayerRole { buildings, contours, roofs, doubtful, rejected, problems, missing };

/// Model of a surface: one block per building, the tiers of its stack, or the planes of its roof.
enum class SurfaceOf { buildings, contours, roofs };

/// Height of a block: a percentile, the maximum or the mean of its points.
enum class SurfaceRoof { p50, p70, p90, p95, max, mean };

/// Number of objects in a surface of triangles: one per building, or one for all.
enum class SurfaceSolids { one, each };

/// ISO 216 paper of a map.
enum class Paper { a0, a1, a2, a3, a4, a5 };

/// Naming scheme of the fields of buildings.
enum class FieldNames { own, urock, city4cfd, osm };

struct WriteOptions {
    std::string destination;
    std::string footprints;        ///< existing polygons that get heights; "": buildings are outlined
    std::string footprints_layer;  ///< their layer; "": the first with geometries
    std::string format;            ///< OGR short name; deduced from the extension if empty
    std::vector<std::string> dataset_options;  ///< NAME=VALUE
    std::vector<std::string> layer_options;    ///< NAME=VALUE
    std::string layer_name;
    std::optional<Layers> layers;  ///< by default those that the format can hold
    bool overwrite = false;
    bool append = false;
    bool with_z = false;
    bool roofs = false;     ///< also write a layer of the faces of roofs
    bool doubtful = false;  ///< also write a layer of possible buildings
    bool rejected = false;  ///< also write a layer of dropped or changed contours, with reasons
    bool problems = false;  ///< also write a layer of places changed for closed surfaces
    FieldNames fields = FieldNames::own;
    double storey_height = 3;             ///< m, for the number of floors
    std::string ground;                   ///< GeoTIFF of the terrain; "": none
    std::string height;                   ///< GeoTIFF of the heights above it
    std::string canopy;                   ///< GeoTIFF of the heights of everything except buildings
    std::vector<std::string> surfaces;    ///< files of the surface of the buildings
    std::optional<SurfaceOf> surface_of;  ///< by default the preset decides
    /// The mean, because a flat roof at that height encloses the same volume as the measured one.
    SurfaceRoof surface_roof = SurfaceRoof::mean;
    SurfaceSolids surface_solids = SurfaceSolids::each;  ///< applies to OBJ and STL
    /// x, y, z of the local origin in metres; by default near the centre
    std::optional<std::array<double, 3>> surface_origin;
    std::string page;     ///< HTML page of the buildings in 3D; "": none
    std::string preview;  ///< picture of the result over the shaded relief; PNG, SVG or PDF by its extension
    int preview_size = 1600;              ///< pixels of its longer side
    std::optional<Paper> preview_paper;   ///< instead of preview_size
    std::optional<double> preview_scale;  ///< denominator; by default a round one that fits the paper
    bool landscape = false;               ///< the longer side of the paper is its width
    std::string title;                    ///< of the page and the picture; "": none
    std::string credit;                   ///< source and licence of the data, on the page and the picture

    [[nodiscard]] bool has_footprints() const { return !footprints.empty(); }
};

struct RunOptions {
    int threads = 0;  ///< 0: one per core
};

struct Options {
    Preset preset = Preset::buildings;
    RunOptions run;
    ReadOptions read;
    GroundOptions ground;
    DetectOptions detect;
    LevelOptions levels;
    TraceOptions trace;
    FilterOptions filter;
    OutlineOptions outline;
    RoofOptions roofs;
    WriteOptions write;
    /// Options given by name, without dash. Needed because a field set to its default value looks unset.
    std::set<std::string, std::less<>> given;
};

/// Sets an option by its name on the command line; docs/reference/options.md lists them. @param name with or
/// without dashes, or an alias @param values as texts; none for a switch @throws OptionError: unknown option
/// or invalid values. Contradictions between options are detected when a run begins
void set_option(Options& options, std::string_view name, const std::vector<std::string>& values = {});

}  // namespace d2b
