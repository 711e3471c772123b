#pragma once

#include <span>
#include <vector>

#include "geometry/geos_polygons.hpp"

namespace d2b {

/// Coverage of polygons, as disjoint polygons.
struct Cover {
    std::vector<WorldPolygon> once;   ///< their union
    std::vector<WorldPolygon> twice;  ///< area covered by two or more of them
};

enum class CoverKind { once, once_and_twice };

/// Computes the coverage by cascaded union: an area is covered twice if it is so in one half or lies in both.
/// @param features each valid; may be empty @param kind `once` leaves the list `twice` empty @throws Error
[[nodiscard]] Cover cover_of(const GeosPolygons& geos, std::span<const std::vector<WorldPolygon>> features,
                             CoverKind kind);

}  // namespace d2b
