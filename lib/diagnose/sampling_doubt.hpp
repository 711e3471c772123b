#pragma once

#include <string>

#include "dem2buildings/report.hpp"

namespace d2b {

/// That points are too thin: no point fell into more than 8 % of the cells. From there on the judge of
/// detect/ goes by its weights for thin points alone, and in docs/accuracy.md half of the small houses are
/// missed. Without a full stop; "" where they are not.
/// @param side of a cell, metres
[[nodiscard]] std::string thin_doubt(const SamplingReport& report, double side);

/// That walls are smeared: they fall over more than 2.5 cells. Likewise.
[[nodiscard]] std::string blur_doubt(const SamplingReport& report, double side);

/// That elevations were rounded to half a metre or more. Likewise. @param metres in the vertical unit
[[nodiscard]] std::string rounding_doubt(const SamplingReport& report, double metres);

}  // namespace d2b
