#pragma once

#include "core/band.hpp"
#include "core/context.hpp"

namespace d2b {

/// Detection of the thesis preset: all cells above the ground level belong to one object with one label,
/// because the contours alone separate buildings. Pointwise: no halo, no state.
[[nodiscard]] LabelBand detect_one_label(const ElevationBand& elevations, Context& context);

}  // namespace d2b
