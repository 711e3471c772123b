#pragma once

#include <span>

#include <proj.h>

#include "core/crs/proj_objects.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Returns PROJ's best operation, with axes in GIS order; null if there is none that can be instantiated.
/// @param area may be null; PROJ then uses the CRSs' areas of use
[[nodiscard]] PjPtr operation_between(PJ_CONTEXT* context, const PJ* from, const PJ* to, PJ_AREA* area);

/// Transforms in place; positions that cannot be transformed become infinite or NaN.
void carry_out(PJ* operation, std::span<Position> positions);

}  // namespace d2b
