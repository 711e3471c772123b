#pragma once

#include <vector>

#include "preview/cairo_handles.hpp"
#include "preview/relief.hpp"

namespace d2b {

/// Samples are means of squares of so many cells that there is about one a pixel; where pixels are finer, of
/// one.
struct Relief::Impl {
    explicit Impl(const MapFrame& map);

    void gather(std::span<const float> row);
    /// A row of samples is complete.
    void end_row();
    /// Of the row of samples `here`.
    void shade(const std::vector<double>& below);

    MapFrame frame;
    int step;  ///< cells along the side of a square
    int cols;  ///< of samples
    int rows;
    std::int32_t gathered = 0;   ///< rows of cells
    int shaded = 0;              ///< rows of samples
    std::vector<double> sums;    ///< of the row that is gathered
    std::vector<double> counts;  ///< of the same
    std::vector<double> above;   ///< two rows of samples before it
    std::vector<double> here;
    SurfaceOwner image;
};

/// Over the whole map, whose upper left corner is the pen's origin.
void paint(const Relief& relief, cairo_t* pen);

}  // namespace d2b
