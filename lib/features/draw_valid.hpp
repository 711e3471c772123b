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
    std::string trouble;  ///< GEOS's reason why the first drawing is invalid; "" if it is valid
};

/// Draws the parts. May throw GeometryError.
using DrawParts = std::function<std::vector<WorldPolygon>()>;

/// Returns parts that GEOS accepts as valid: the drawn ones; otherwise, or if GEOS fails on them, the traced
/// ones; otherwise repaired ones; and none if repair fails as well. Fallbacks are counted. Never throws for a
/// bad polygon, because one feature must not end the run.
/// @param status set to kept_traced or repaired after a fallback
[[nodiscard]] ValidParts draw_valid(const DrawParts& drawn, const DrawParts& traced, Geos& geos,
                                    OutlineStatus& status, Tally& tally);

}  // namespace d2b
