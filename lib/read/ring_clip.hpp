#pragma once

#include <limits>
#include <span>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// A part of the plane, its sides included; without limits where nothing else is said.
struct ClipBox {
    double left = -std::numeric_limits<double>::infinity();
    double bottom = -std::numeric_limits<double>::infinity();
    double right = std::numeric_limits<double>::infinity();
    double top = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool holds(std::span<const Position> ring) const;
};

/// What of a ring lies in a box, along whose sides its parts may be joined (Sutherland and Hodgman, 1974):
/// within the box a point is inside of both or of neither. A ring that lies in it whole is left as it is.
/// @param ring may be closed by a repeated position @return closed by one; empty where nothing lies in the
/// box
[[nodiscard]] WorldRing clipped(const WorldRing& ring, const ClipBox& box);

}  // namespace d2b
