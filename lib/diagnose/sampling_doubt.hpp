#pragma once

#include <string>

#include "dem2buildings/report.hpp"

namespace d2b {

/// Returns a warning if points are too sparse: more than 8 % of the cells have no point. Beyond that the
/// classifier of detect/ uses its weights for sparse points alone, and half of the small houses in
/// docs/accuracy.md are missed. A clause without a full stop; "" if points are dense enough.
/// @param side cell size in m
[[nodiscard]] std::string thin_doubt(const SamplingReport& report, double side);

/// Same, if walls are blurred: they fall over more than 2.5 cells.
[[nodiscard]] std::string blur_doubt(const SamplingReport& report, double side);

/// Same, if elevations were rounded to half a metre or more.
/// @param metres metres per vertical unit
[[nodiscard]] std::string rounding_doubt(const SamplingReport& report, double metres);

}  // namespace d2b
