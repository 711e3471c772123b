#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// What parcels are to the middle of a cell.
struct ParcelCell {
    static constexpr std::int64_t nobody = std::numeric_limits<std::int64_t>::min();

    std::int64_t parcel = nobody;  ///< number of the polygon that covers it; of several the lowest
    bool cut_right = false;        ///< a line passes between it and the next of its row
    bool cut_below = false;        ///< likewise of its column
    bool several = false;          ///< more than one polygon covers it
    bool invalid = false;          ///< the polygon is not valid
};

/// Polygons or lines that divide blocks into houses, on the grid of a DEM.
class ParcelSource {
  public:
    ParcelSource() = default;
    ParcelSource(const ParcelSource&) = delete;
    ParcelSource& operator=(const ParcelSource&) = delete;
    virtual ~ParcelSource() = default;

    /// Of a part of the DEM's window, row by row. Which part is asked for does not change what a cell is.
    /// @param cells part.rows * part.cols @throws InputError
    virtual void read(const Window& part, std::span<ParcelCell> cells) = 0;
    /// What identifies a parcel: "" for nobody, and where the file says nothing. It lives as long as the
    /// source does. @throws InputError
    [[nodiscard]] virtual std::string_view name(std::int64_t parcel) = 0;
    /// As DemSource's.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }
};

}  // namespace d2b
