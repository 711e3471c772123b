#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/crs.hpp"
#include "core/crs/lon_lat.hpp"
#include "core/crs/proj_objects.hpp"

namespace d2b {

/// What is known of a CRS. Everything that is ever asked is found out by read(), so that later calls only
/// read.
struct Crs::Impl {
    std::unique_ptr<ProjContext> context;  ///< null where there is no CRS
    PjPtr horizontal;                      ///< of the compound, or all of it; still bound if it was
    Kind kind = Kind::none;
    std::string name;
    std::string wkt;
    std::optional<LengthUnit> horizontal_unit;
    std::optional<LengthUnit> vertical_unit;
    std::unique_ptr<const LonLat> lon_lat;  ///< null where it is not on an ellipsoid; to be copied
    double angular_unit = 0;  ///< degrees in one unit of the horizontal axes, 0 where they are lengths

    void read(std::string_view text);
};

}  // namespace d2b
