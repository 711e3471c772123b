#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace d2b {

/// Options, a struct a stage. This is the only place where a default is written; the option table
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

/// Where `by_preset` stands, the preset decides: see options/preset.hpp.
enum class GroundMode { by_preset, automatic, given, none };

struct GroundOptions {
    GroundMode mode = GroundMode::by_preset;
    std::string terrain;             ///< the terrain model of GroundMode::given
    double max_building_width = 60;  ///< m: the ground is looked for beyond buildings as wide as this
};

struct DetectOptions {
    double min_height = 2;        ///< m above ground
    double min_area_m2 = 30;      ///< of a building; FilterOptions::min_area_m2 where that is given
    double min_confidence = 0.5;  ///< what is below is doubtful
    std::string mask;             ///< raster or polygons: buildings are looked for in them alone
    std::string mask_layer;       ///< of polygons; "": the first with geometries
    std::string ndvi;             ///< raster of the normalised difference vegetation index
    double split_height = 0;      ///< m: a step that divides buildings; 0: none does
};

enum class TraceMode { by_preset, points, cells };

/// What the thresholds of -lod divide: the elevations of each building, in equal slices or at their natural
/// breaks, or those of the whole DEM, in slices.
enum class LevelSource { by_preset, building, natural, global };

struct LevelOptions {
    LevelSource source = LevelSource::by_preset;
    int lod = 4;                     ///< slices of mean +- standard deviation; most natural breaks
    std::vector<double> fixed;       ///< explicit thresholds
    std::optional<double> interval;  ///< thresholds at offset + n * interval
    double offset = 0;
    double detail =
        0;  ///< m: how far a strip a metre wide must stand out to be a tier; 0: the image is not cleaned
};

struct TraceOptions {
    TraceMode mode = TraceMode::by_preset;
};

struct FilterOptions {
    int noise_factor = 10;              ///< fewest grid points on a ring
    std::optional<double> min_area_m2;  ///< smallest area; by preset where it is not given
    bool keep_footprints = false;       ///< contours of level 1 were found by other means: none is noise
};

enum class Walls { by_preset, automatic, off, right, free };

struct OutlineOptions {
    Walls walls = Walls::by_preset;
    /// cells: no outline leaves its trace by more; 1.5, but at most 1.25 m, where it is not given
    std::optional<double> wall_tolerance;
    bool arcs = false;       ///< recognised arcs are written as such
    double simplify = 0;     ///< tolerance in units of the CRS; 0: every corner is kept
    bool disjoint = false;   ///< bands that do not overlap
    std::string target_crs;  ///< "": the DEM's
};

enum class Layers { automatic, both, buildings, contours };
enum class LayerRole { buildings, contours, doubtful, rejected };

/// Whose names the fields of buildings have.
enum class FieldNames { own, urock, city4cfd, osm };

struct WriteOptions {
    std::string destination;
    std::string format;                        ///< OGR short name; by extension where empty
    std::vector<std::string> dataset_options;  ///< NAME=VALUE
    std::vector<std::string> layer_options;    ///< NAME=VALUE
    std::string layer_name;
    Layers layers = Layers::automatic;
    bool overwrite = false;
    bool append = false;
    bool with_z = false;
    bool doubtful = false;  ///< also a layer of what may be a building
    bool rejected = false;  ///< also a layer of what was dropped or changed, with the reason
    FieldNames fields = FieldNames::own;
    std::string ground;   ///< GeoTIFF of the terrain; "": none
    std::string height;   ///< GeoTIFF of the heights above it
    std::string canopy;   ///< GeoTIFF of the heights of what is no building
    std::string preview;  ///< PNG of the result over the shaded relief
};

struct RunOptions {
    int threads = 0;  ///< 0: as many as there are cores
};

struct Options {
    std::string preset = "buildings";
    RunOptions run;
    ReadOptions read;
    GroundOptions ground;
    DetectOptions detect;
    LevelOptions levels;
    TraceOptions trace;
    FilterOptions filter;
    OutlineOptions outline;
    WriteOptions write;
};

}  // namespace d2b
