#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/crs.hpp"
#include "core/crs/lon_lat.hpp"
#include "core/crs/proj.hpp"

namespace d2b {

/// Definition of a CRS. read() computes everything, so that it is immutable afterwards.
struct Crs::Impl {
    std::unique_ptr<ProjContext> context;  ///< null if there is no CRS
    PjPtr horizontal;                      ///< horizontal part, or the CRS itself; still bound if it was
    Kind kind = Kind::none;
    std::string name;
    std::string wkt;
    std::optional<LengthUnit> horizontal_unit;
    std::optional<LengthUnit> vertical_unit;
    std::unique_ptr<const LonLat> lon_lat;  ///< null if not on an ellipsoid; copied by users
    double angular_unit = 0;  ///< degrees in one unit of the horizontal axes; 0 if they are lengths

    void read(std::string_view text);
};

}  // namespace d2b
