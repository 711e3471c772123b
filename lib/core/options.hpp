#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace d2b {

/// Options, a struct a stage. This is the only place where a default is written; the option table
/// (pipeline/option_table.hpp) gives each its name, unit, range and help.

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
    std::optional<double> nodata;                           ///< overrides the file's
    bool ignore_nodata = false;
    std::string vertical_unit;  ///< "m", "ft", "us-ft" or metres in a unit; found where empty
};

enum class TraceMode { points, cells };

struct LevelOptions {
    int lod = 4;                     ///< slices of mean +- standard deviation
    std::vector<double> fixed;       ///< explicit thresholds
    std::optional<double> interval;  ///< thresholds at offset + n * interval
    double offset = 0;
};

struct TraceOptions {
    TraceMode mode = TraceMode::points;
};

struct FilterOptions {
    int noise_factor = 10;  ///< fewest grid points on a ring
    double min_area_m2 = 0;
};

struct OutlineOptions {
    double simplify = 0;     ///< tolerance in units of the CRS; 0: every corner is kept
    bool disjoint = false;   ///< bands that do not overlap
    std::string target_crs;  ///< "": the DEM's
};

enum class Layers { automatic, both, buildings, contours };

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
};

struct Options {
    std::string preset = "thesis";
    ReadOptions read;
    LevelOptions levels;
    TraceOptions trace;
    FilterOptions filter;
    OutlineOptions outline;
    WriteOptions write;
};

}  // namespace d2b
