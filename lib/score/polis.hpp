#pragma once

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// PoLiS distance (Avbelj, Mueller, Bamler 2015): half the mean distance of the vertices of each polygon to
/// the outline of the other, summed over both directions. In units of the coordinates; includes interior
/// rings.
[[nodiscard]] double polis_distance(const WorldPolygon& a, const WorldPolygon& b);

}  // namespace d2b
