#include "detect/element.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {

Element disk_element(double radius_m, const CellSize& cell) {
    // A hair more, since 1.5 m are three cells of 0.5 m.
    const double radius = radius_m * (1 + 1e-9);
    if (radius < std::max(cell.across, cell.down))
        return {{0, 0, 1}, {1, 0, 1}};
    const auto rows = static_cast<std::int32_t>(radius / cell.down);
    Element element;
    for (std::int32_t r = -rows; r <= rows; ++r) {
        const double y = r * cell.down;
        const auto half = static_cast<std::int32_t>(std::sqrt(radius * radius - y * y) / cell.across);
        element.push_back({r, -half, half});
    }
    return element;
}

}  // namespace d2b
