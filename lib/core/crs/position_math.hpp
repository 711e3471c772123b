#pragma once

#include <cmath>

#include "core/feature_sink.hpp"

namespace d2b {

[[nodiscard]] inline bool is_finite(const Position& p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

[[nodiscard]] inline double squared_length(const Position& v) {
    return v.x * v.x + v.y * v.y;
}

/// @param share of the way along an edge from its start
[[nodiscard]] inline Position point_along(const Position& start, const Position& along, double share) {
    return {start.x + along.x * share, start.y + along.y * share};
}

}  // namespace d2b
