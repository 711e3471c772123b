#pragma once

#include <memory>
#include <span>

#include <proj.h>

#include "dem2buildings/sinks.hpp"

namespace d2b {

struct AreaDelete {
    void operator()(PJ_AREA* area) const { proj_area_destroy(area); }
};
using AreaPtr = std::unique_ptr<PJ_AREA, AreaDelete>;

/// @param crs of the positions @returns null if the area is unknown; PROJ then uses the CRSs' areas of use
[[nodiscard]] AreaPtr area_of(const PJ* crs, std::span<const Position> positions);

}  // namespace d2b
