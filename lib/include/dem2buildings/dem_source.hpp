#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dem2buildings/dem_info.hpp"

namespace d2b {

/// Where elevations come from: a file (read/), or an array in tests and in other programs.
class DemSource {
  public:
    DemSource() = default;
    DemSource(const DemSource&) = delete;
    DemSource& operator=(const DemSource&) = delete;
    virtual ~DemSource() = default;

    [[nodiscard]] virtual const DemInfo& info() const = 0;

    /// Elevations of whole rows of the window, row by row, in the band's vertical unit with scale and offset
    /// applied; NaN where a point is not valid (NoData, mask, alpha, NaN, infinite, outside the cutline).
    /// Several threads may call it at a time.
    /// @param first_row  of the whole raster; window.row <= first_row
    /// @param rows       first_row + rows <= window.row + window.rows
    /// @param elevations rows * window.cols values
    /// @throws InputError
    virtual void read(std::int32_t first_row, std::int32_t rows, std::span<double> elevations) = 0;

    /// What reading it has shown since the last call, a sentence each, for the run to warn of. Called from
    /// the thread that called run(), while others may read.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }
    /// Of a terrain model, cells that are not valid because no elevation can be what they hold; known when
    /// the last row has been read.
    [[nodiscard]] virtual std::int64_t cells_outside_range() const { return 0; }
};

}  // namespace d2b
