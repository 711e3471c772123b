#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Parcels at the centre of a cell.
struct ParcelCell {
    static constexpr std::int64_t no_parcel = std::numeric_limits<std::int64_t>::min();

    std::int64_t parcel = no_parcel;  ///< number of the covering polygon, the lowest if there are several
    bool cut_right = false;           ///< a line passes between this cell and the next one in its row
    bool cut_below = false;           ///< a line passes between this cell and the next one in its column
    bool several = false;             ///< more than one polygon covers it
    bool invalid = false;             ///< the polygon is not valid
};

/// Source of polygons or lines that divide blocks into houses, on the grid of a DEM.
class ParcelSource {
  public:
    ParcelSource() = default;
    ParcelSource(const ParcelSource&) = delete;
    ParcelSource& operator=(const ParcelSource&) = delete;
    virtual ~ParcelSource() = default;

    /// Reads a part of the DEM's window, row by row. The value of a cell does not depend on the part. @param
    /// cells part.rows * part.cols @throws InputError
    virtual void read(const Window& part, std::span<ParcelCell> cells) = 0;
    /// Returns the identifier of a parcel: "" for nobody, or if the file has none. Valid as long as the
    /// source. @throws InputError
    [[nodiscard]] virtual std::string_view name(std::int64_t parcel) = 0;
    /// Same as DemSource::take_warnings().
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }
};

}  // namespace d2b
