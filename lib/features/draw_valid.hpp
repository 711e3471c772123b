#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dem2buildings/report.hpp"
#include "geometry/geos.hpp"
#include "outline/outline.hpp"

namespace d2b {

struct ValidParts {
    std::vector<WorldPolygon> parts;
    std::string trouble;  ///< what GEOS said of the polygon as it was drawn; "" where it is valid
};

/// May throw GeometryError.
using DrawParts = std::function<std::vector<WorldPolygon>()>;

/// Polygons that GEOS has found valid. Where the drawn ones are not, or GEOS fails on them, the traced ones;
/// where these are not either, repaired ones, and none where that fails as well. What happened is counted,
/// and no polygon ends the run.
/// @param status becomes kept_traced or repaired where that is what is left
[[nodiscard]] ValidParts draw_valid(const DrawParts& drawn, const DrawParts& traced, Geos& geos,
                                    OutlineStatus& status, Tally& tally);

}  // namespace d2b
