#pragma once

#include "core/band.hpp"
#include "core/context.hpp"

namespace d2b {

/// Detection of the thesis preset: everything that stands above the ground level is an object of one label;
/// what separates buildings are the contours alone. Pointwise: no halo, nothing carried.
[[nodiscard]] LabelBand detect_one_label(const ElevationBand& elevations, Context& context);

}  // namespace d2b
