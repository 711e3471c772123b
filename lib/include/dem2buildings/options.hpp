#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace d2b {

/// Options, one struct per stage. This is the only place where a default is written; the option table
/// (options/option_table.hpp) gives each its name, unit, range and help.

struct ReadOptions {
    std::string source;  ///< anything that GDAL opens
    int band = 1;
    std::vector<std::string> open_options;                  ///< NAME=VALUE
    std::vector<std::string> drivers;                       ///< formats to try; all where empty
    std::string crs;                                        ///< overrides the file's
    std::optional<std::array<double, 4>> source_window;     ///< column, row, columns, rows
    std::optional<std::array<double, 4>> projected_window;  ///< ulx, uly, lrx, lry
    std::optional<std::array<double, 4>> extent;            ///< xmin, ymin, xmax, ymax
    std::string cutline;                                    ///< polygons that bound the area of interest
    std::string cutline_layer;                              ///< its layer; "": the first with geometries
    std::optional<double> nodata;                           ///< overrides the file's
    bool ignore_nodata = false;
    std::string vertical_unit;  ///< "m", "ft", "us-ft" or metres in a unit; found where empty
    /// lowest and highest elevation in the vertical unit; what occurs on land where it is not given
    std::optional<std::array<double, 2>> elevation_range;
};

/// A method, with what it decides where an option is left open.
enum class Preset {
    buildings,  ///< ground and buildings are found, outlines get straight walls
    thesis      ///< that of Chittineni (2003): everything above a threshold is taken for a building
};

enum class GroundMode { automatic, given, none };

struct GroundOptions {
    std::optional<GroundMode> mode;
    std::string terrain;             ///< the terrain model of GroundMode::given
    double max_building_width = 60;  ///< m: the ground is looked for beyond buildings as wide as this
};

struct DetectOptions {
    double min_height = 2;           ///< m above ground
    double min_building_height = 0;  ///< m: buildings of which nine tenths are lower are left out
    double min_confidence = 0.5;     ///< what is below is doubtful
    std::string mask;                ///< raster or polygons: buildings are looked for in them alone
    std::string mask_layer;          ///< of polygons; "": the first with geometries
    std::string ndvi;                ///< raster of the normalised difference vegetation index
    double split_height = 0;         ///< m: a step that divides buildings; 0: none does
    std::string split_by;            ///< polygons or lines that cut buildings, such as parcels
    std::string split_layer;         ///< of these; "": the first with geometries
    std::string split_field;         ///< that identifies a polygon; "": the feature's id
    double split_width = 1.5;        ///< m: what is narrower is not cut off

    [[nodiscard]] bool is_split_by() const { return !split_by.empty(); }
};

enum class TraceMode { points, cells };

/// What the thresholds of -lod divide: the elevations of each building, in equal slices or at their natural
/// breaks, or those of the whole DEM, in slices.
enum class LevelSource { building, natural, global };

struct LevelOptions {
    std::optional<LevelSource> source;
    int lod = 4;                     ///< slices of mean +- standard deviation; most natural breaks
    std::vector<double> fixed;       ///< explicit thresholds
    std::optional<double> interval;  ///< thresholds at offset + n * interval
    double offset = 0;
    /// m: how far a strip must stand out to be a tier that is a metre wide, or a cell where cells are larger;
    /// 0: the image is not cleaned
    std::optional<double> detail;
};

struct TraceOptions {
    std::optional<TraceMode> mode;
};

struct FilterOptions {
    int noise_factor = 10;  ///< fewest grid points on a ring
    std::optional<double>
        min_area_m2;  ///< smallest area of a building, or of a contour where none is looked for
};

enum class Walls { automatic, off, right, free };

struct OutlineOptions {
    std::optional<Walls> walls;
    std::optional<double> wall_tolerance;  ///< cells: no outline leaves its trace by more
    double wall_inset = 0;                 ///< cells: straight walls stand so far inward, see -wall_inset
    bool arcs = false;                     ///< recognised arcs are written as such
    double simplify = 0;                   ///< tolerance in units of the CRS; 0: every corner is kept
    bool disjoint = false;                 ///< bands that do not overlap
    std::string target_crs;                ///< "": the DEM's
    double flow_ready = 0;                 ///< m: gaps and walls that are shorter are changed; 0: none
    std::optional<double> min_gap;         ///< m: of gaps alone
    std::optional<double> min_wall;        ///< m: of walls alone

    [[nodiscard]] double narrowest_gap() const { return min_gap.value_or(flow_ready); }
    [[nodiscard]] double shortest_wall() const { return min_wall.value_or(flow_ready); }
    [[nodiscard]] bool is_flow_ready() const { return narrowest_gap() > 0 || shortest_wall() > 0; }
};

enum class Layers { both, buildings, contours };
enum class LayerRole { buildings, contours, doubtful, rejected, problems };

/// What a surface is made of: one block a building, or the tiers of its stack.
enum class SurfaceOf { buildings, contours };

/// The height of a block: what so many of its points do not exceed, in percent, its highest, or their mean.
enum class SurfaceRoof { p50, p70, p90, p95, max, mean };

/// Whether a surface of triangles has an object of its own for each building, or one for all.
enum class SurfaceSolids { one, each };

/// Whose names the fields of buildings have.
enum class FieldNames { own, urock, city4cfd, osm };

struct WriteOptions {
    std::string destination;
    std::string format;                        ///< OGR short name; by extension where empty
    std::vector<std::string> dataset_options;  ///< NAME=VALUE
    std::vector<std::string> layer_options;    ///< NAME=VALUE
    std::string layer_name;
    std::optional<Layers> layers;  ///< those that the format holds where it is not given
    bool overwrite = false;
    bool append = false;
    bool with_z = false;
    bool doubtful = false;  ///< also a layer of what may be a building
    bool rejected = false;  ///< also a layer of what was dropped or changed, with the reason
    bool problems = false;  ///< also a layer of the places that closed surfaces had to be changed at
    FieldNames fields = FieldNames::own;
    std::string ground;                   ///< GeoTIFF of the terrain; "": none
    std::string height;                   ///< GeoTIFF of the heights above it
    std::string canopy;                   ///< GeoTIFF of the heights of what is no building
    std::vector<std::string> surfaces;    ///< files of the surface of the buildings
    std::optional<SurfaceOf> surface_of;  ///< as the preset has it where it is not given
    /// The mean, because a flat roof at that height encloses as much as the roof that was measured.
    SurfaceRoof surface_roof = SurfaceRoof::mean;
    SurfaceSolids surface_solids = SurfaceSolids::each;  ///< of OBJ and STL
    /// x, y, z in metres that local coordinates begin at; a place in the middle where it is not given
    std::optional<std::array<double, 3>> surface_origin;
    std::string page;     ///< HTML page of the buildings in 3D; "": none
    std::string preview;  ///< picture of the result over the shaded relief, PNG, SVG or PDF by its extension
    int preview_size = 1600;  ///< pixels of its longer side
};

struct RunOptions {
    int threads = 0;  ///< 0: as many as there are cores
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
    WriteOptions write;
    /// Names of options that were given by name, without dash. A field that is set shows by its value, but
    /// not where that is the default.
    std::set<std::string, std::less<>> given;
};

/// Sets an option by the name that it has on the command line; docs/options.md lists them.
/// @param name with or without dashes, or an alias @param values as texts; none for a switch
/// @throws OptionError: no such option, or values that it does not take. What contradicts another option is
/// found when a run begins
void set_option(Options& options, std::string_view name, const std::vector<std::string>& values = {});

}  // namespace d2b
