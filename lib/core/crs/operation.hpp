#pragma once

#include <span>

#include <proj.h>

#include "core/crs/proj_objects.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// The best operation of PROJ in GIS order; null where there is none that can be carried out.
/// @param area may be null: PROJ then goes by the CRSs' areas of use
[[nodiscard]] PjPtr operation_between(PJ_CONTEXT* context, const PJ* from, const PJ* to, PJ_AREA* area);

/// In place; positions without image become infinite or NaN.
void carry_out(PJ* operation, std::span<Position> positions);

}  // namespace d2b
