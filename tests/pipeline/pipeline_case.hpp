#pragma once

#include <vector>

#include "core/crs.hpp"
#include "dem2buildings/run.hpp"
#include "support/memory_io.hpp"

namespace d2b::test {

/// Layers, in the order in which they are written.
inline constexpr std::size_t buildings = 0;
inline constexpr std::size_t contours = 1;
inline constexpr std::size_t doubtful = 2;

/// 10 x 12 cells: a block of 4 x 6 cells of 20 on ground of 5.
inline MemorySource block() {
    std::vector<double> z(120, 5);
    for (int row = 3; row < 7; ++row)
        for (int col = 2; col < 8; ++col)
            z[static_cast<std::size_t>(row * 12 + col)] = 20;
    return {10, 12, z};
}

/// Puts a raster into UTM zone 32N, north up.
inline void place_in_utm(MemorySource& source, double cell_m) {
    source.edit().transform = {600000, cell_m, 0, 5800000, 0, -cell_m};
    source.edit().crs_wkt = Crs("EPSG:25832").wkt();
}

inline Options cells(std::vector<double> thresholds) {
    Options options;
    options.preset = Preset::thesis;
    options.trace.mode = TraceMode::cells;
    options.levels.fixed = std::move(thresholds);
    options.filter.noise_factor = 0;
    return options;
}

struct Result {
    Result() = default;
    Result(MemorySource& source, const Options& options) { report = run(options, {source}, {sink}); }
    MemorySink sink;
    RunReport report;
};

inline double area_of(const std::vector<WorldPolygon>& parts) {
    Geodesy planar{Crs()};
    double area = 0;
    for (const WorldPolygon& part : parts)
        area += planar.polygon(part).area_m2;
    return area;
}

inline void run_on(MemorySource& source, const Options& options, Result& result) {
    result.report = run(options, {source}, {result.sink});
}

}  // namespace d2b::test
