#pragma once

#include <span>
#include <vector>

#include "geometry/geos_polygons.hpp"

namespace d2b {

/// What polygons cover, as polygons that do not overlap.
struct Cover {
    std::vector<WorldPolygon> once;   ///< their union
    std::vector<WorldPolygon> twice;  ///< what two or more of them cover
};

enum class CoverKind { once, once_and_twice };

/// Halves of the features are put together: what is covered twice is so in a half, or lies in both.
/// @param features each valid; may be empty @param kind without `twice`, that list stays empty @throws Error
[[nodiscard]] Cover cover_of(const GeosPolygons& geos, std::span<const std::vector<WorldPolygon>> features,
                             CoverKind kind);

}  // namespace d2b
