#pragma once

#include <cstddef>
#include <limits>
#include <string>

#include "dem2buildings/sinks.hpp"
#include "support/error_of.hpp"

namespace d2b::test {

inline constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline const std::string local_feet = R"(LOCAL_CS["site grid",UNIT["foot",0.3048]])";
inline const std::string local_unknown =
    R"(ENGCRS["somewhere",EDATUM["unknown"],CS[Cartesian,2],AXIS["x",unspecified,ORDER[1],LENGTHUNIT["unknown",0]],)"
    R"(AXIS["y",unspecified,ORDER[2],LENGTHUNIT["unknown",0]]])";
inline const std::string wgs84_wkt1 =
    R"(GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],)"
    R"(UNIT["degree",0.0174532925199433]])";
inline const std::string unknown_projection =
    R"(PROJCS["odd",)" + wgs84_wkt1 + R"(,PROJECTION["No_Such_Thing"],UNIT["metre",1]])";

inline WorldRing rectangle(double x, double y, double width, double height) {
    return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

/// Every edge in n pieces.
inline WorldRing densified(const WorldRing& ring, int n) {
    WorldRing result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& a = ring[i];
        const Position& b = ring[(i + 1) % ring.size()];
        for (int k = 0; k < n; ++k)
            result.push_back({a.x + (b.x - a.x) * k / n, a.y + (b.y - a.y) * k / n});
    }
    return result;
}

}  // namespace d2b::test
