#pragma once

#include <limits>
#include <span>

namespace d2b {

/// Range of values; inverted if empty.
struct RowExtremes {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();
};

/// Returns the range of all values that are not NaN. If both 0 and -0 are extreme, either may be returned.
[[nodiscard]] RowExtremes extremes_of_row(std::span<const double> values);

}  // namespace d2b
