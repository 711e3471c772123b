#pragma once

#include <optional>
#include <string>

#include <proj.h>

#include "core/crs.hpp"

namespace d2b {

struct AxisUnit {
    std::string name;
    double factor = 0;  ///< metres or radians in one unit
};

/// Empty if the CRS has no such axis.
[[nodiscard]] std::optional<AxisUnit> axis_unit(PJ_CONTEXT* context, const PJ* crs, int axis);

[[nodiscard]] double to_degrees(double radians);

/// Empty if the unit is unknown.
[[nodiscard]] std::optional<LengthUnit> length_unit(const std::optional<AxisUnit>& unit);

/// @param whole the CRS as given @param horizontal its horizontal part, not bound
[[nodiscard]] std::optional<LengthUnit> vertical_unit_of(PJ_CONTEXT* context, const PJ* whole,
                                                         const PJ* horizontal);

}  // namespace d2b
