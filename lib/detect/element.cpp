#include "detect/element.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {

namespace {

// Tolerance, because 1.5 m have to be exactly three cells of 0.5 m.
constexpr double hair = 1 + 1e-9;

}  // namespace

bool disk_fits(double radius_m, const CellSize& cell) {
    return radius_m * hair >= std::max(cell.across, cell.down);
}

Element disk_element(double radius_m, const CellSize& cell) {
    const double radius = radius_m * hair;
    if (!disk_fits(radius_m, cell))
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
