#pragma once

#include <limits>
#include <span>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Axis-parallel box, sides included; unbounded by default.
struct ClipBox {
    double left = -std::numeric_limits<double>::infinity();
    double bottom = -std::numeric_limits<double>::infinity();
    double right = std::numeric_limits<double>::infinity();
    double top = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool holds(std::span<const Position> ring) const;
};

/// Clips a ring to a box (Sutherland and Hodgman, 1974). Parts may be joined along the sides of the box;
/// within the box, points keep their even-odd parity. A ring inside the box is returned unchanged.
/// @param ring may be closed by a repeated position @return closed by a repeated position; empty if outside
/// of the box
[[nodiscard]] WorldRing clipped(const WorldRing& ring, const ClipBox& box);

}  // namespace d2b
