#pragma once

namespace d2b {

/// A position in a CRS, in the order that GIS programs use: x is easting or longitude, y northing or
/// latitude.
struct Position {
    double x = 0;
    double y = 0;

    friend bool operator==(const Position&, const Position&) = default;
};

}  // namespace d2b
