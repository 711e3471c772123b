#pragma once

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// The PoLiS distance (Avbelj, Mueller, Bamler 2015): half the mean distance of the vertices of one polygon
/// to the outline of the other, plus the same the other way round. In units of the coordinates; vertices and
/// outlines of interior rings count.
[[nodiscard]] double polis_distance(const WorldPolygon& a, const WorldPolygon& b);

}  // namespace d2b
