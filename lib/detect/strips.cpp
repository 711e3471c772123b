#include "detect/strips.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace d2b {

std::vector<Strip> strips_of(const Window& window, const CellSize& cell, double around,
                             const StripSize& size) {
    constexpr double fewest_around = 64;
    constexpr std::int64_t fewest_own = 64;
    if (std::int64_t{window.rows} * window.cols <= size.most_whole)
        return {{{0, window.rows}, {0, window.rows}}};
    const auto more = static_cast<std::int64_t>(
        std::clamp(std::ceil(around / cell.down), fewest_around, static_cast<double>(window.rows)));
    const std::int64_t own = std::max(size.most_in_strip / window.cols - 2 * more, fewest_own);
    const std::int64_t count = (window.rows + own - 1) / own;
    std::vector<Strip> strips;
    for (std::int64_t i = 0; i < count; ++i) {
        const auto begin = static_cast<std::int32_t>(window.rows * i / count);
        const auto end = static_cast<std::int32_t>(window.rows * (i + 1) / count);
        strips.push_back({{begin, end},
                          {static_cast<std::int32_t>(std::max<std::int64_t>(begin - more, 0)),
                           static_cast<std::int32_t>(std::min<std::int64_t>(end + more, window.rows))}});
    }
    return strips;
}

}  // namespace d2b
