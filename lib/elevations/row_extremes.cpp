#include "elevations/row_extremes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/processors.hpp"

namespace d2b {

/// Uses lanes, so that the loop vectorises; their number keeps the compiler from unrolling the loop over
/// them.
D2B_FOR_EACH_PROCESSOR RowExtremes extremes_of_row(std::span<const double> values) {
    constexpr std::size_t lanes = 64;
    std::array<double, lanes> lowest{};
    std::array<double, lanes> highest{};
    lowest.fill(RowExtremes{}.lowest);
    highest.fill(RowExtremes{}.highest);
    const auto look = [&](double z, std::size_t lane) {
        lowest[lane] = z < lowest[lane] ? z : lowest[lane];
        highest[lane] = z > highest[lane] ? z : highest[lane];
    };
    std::size_t i = 0;
    for (; i + lanes <= values.size(); i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            look(values[i + lane], lane);
    for (; i < values.size(); ++i)
        look(values[i], 0);
    return {std::ranges::min(lowest), std::ranges::max(highest)};
}

}  // namespace d2b
