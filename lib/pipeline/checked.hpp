#pragma once

#include <functional>
#include <vector>

#include "core/report.hpp"
#include "geometry/geos.hpp"
#include "outline/outline.hpp"

namespace d2b {

/// Polygons that GEOS has found valid. Where the drawn ones are not, the traced ones; where these are not
/// either, repaired ones. What happened is counted.
/// @param traced asked for only when it is needed
[[nodiscard]] std::vector<WorldPolygon> checked(std::vector<WorldPolygon> drawn,
                                                const std::function<std::vector<WorldPolygon>()>& traced,
                                                Geos& geos, OutlineStatus& status, Tally& tally);

}  // namespace d2b
