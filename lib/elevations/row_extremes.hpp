#pragma once

#include <limits>
#include <span>

namespace d2b {

/// The lowest and highest value; the other way round where there is none.
struct RowExtremes {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();
};

/// Of many values, those that are not NaN. Of 0 and -0, which are as low as each other, either may be named.
[[nodiscard]] RowExtremes extremes_of_row(std::span<const double> values);

}  // namespace d2b
