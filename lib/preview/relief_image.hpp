#pragma once

#include <vector>

#include "preview/cairo_handles.hpp"
#include "preview/relief.hpp"

namespace d2b {

/// Downsampled relief. Each sample is the mean of a square of cells, sized for about one sample per pixel; if
/// pixels are smaller than cells, each cell is a sample.
struct Relief::Impl {
    explicit Impl(const MapFrame& map);

    void gather(std::span<const float> row);
    /// Completes a row of samples.
    void end_row();
    /// Shades the row of samples `here`.
    void shade(const std::vector<double>& below);

    MapFrame frame;
    int step;  ///< side of a square in cells
    int cols;  ///< number of sample columns
    int rows;
    std::int32_t gathered = 0;   ///< rows of cells
    int shaded = 0;              ///< rows of samples
    std::vector<double> sums;    ///< sums of the current row of samples
    std::vector<double> counts;  ///< counts of valid cells, likewise
    std::vector<double> above;   ///< row of samples before `here`
    std::vector<double> here;
    SurfaceOwner image;
};

/// Paints over the whole map, whose upper left corner is the origin of the pen.
void paint(const Relief& relief, cairo_t* pen);

}  // namespace d2b
