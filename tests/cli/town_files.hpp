#pragma once

#include "pipeline/made_town.hpp"
#include "read/rasters.hpp"

namespace d2b::test {

/// Values on the grid of the made town, as a raster in EPSG:25833 whose upper left corner is at 391000,
/// 5820000.
[[nodiscard]] inline RasterSpec town_raster(std::vector<double> values) {
    RasterSpec spec;
    spec.cols = MadeTown::cols;
    spec.rows = MadeTown::rows;
    spec.type = GDT_Float32;
    spec.values = std::move(values);
    spec.transform = std::array<double, 6>{391000, 1, 0, 5820000, 0, -1};
    spec.crs = "EPSG:25833";
    return spec;
}

/// The middle of a box in these coordinates.
[[nodiscard]] inline Position town_middle(const Box& box) {
    return {391000 + box.col + box.cols / 2.0, 5820000 - box.row - box.rows / 2.0};
}

}  // namespace d2b::test
