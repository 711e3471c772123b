#include "diagnose/ground_slope.hpp"

#include <algorithm>
#include <cstddef>

#include "diagnose/words.hpp"

namespace d2b {

void add_slope(const MetreGrid& ground, const CellSize& cell, std::int32_t first_row, const Window& cells,
               GroundSlope& slope) {
    constexpr std::int32_t every = 16;
    const auto end_col = static_cast<std::size_t>(std::min(cells.end_col(), ground.cols - 1));
    for (std::int32_t r = cells.row; r < std::min(cells.end_row(), ground.rows - 1); ++r) {
        if ((first_row + r) % every != 0)
            continue;
        const auto here = ground.row(r);
        const auto below = ground.row(r + 1);
        for (auto c = static_cast<std::size_t>(cells.col); c < end_col; ++c)
            slope.add(static_cast<double>(here[c + 1] - here[c]) / cell.across,
                      static_cast<double>(below[c] - here[c]) / cell.down);
    }
}

std::string slope_doubt(const GroundSlope& slope, const std::string& dem) {
    if (2 * slope.steep_cells <= slope.cells)
        return {};
    const double share = static_cast<double>(slope.steep_cells) / static_cast<double>(slope.cells);
    return percent(share) + " of the ground of '" + dem + "' is steeper than " + percent(GroundSlope::steep) +
           ", where buildings can hardly be told from the slope; give a terrain model with -ground, and "
           "check the units of elevations and coordinates (-zunit)";
}

}  // namespace d2b
