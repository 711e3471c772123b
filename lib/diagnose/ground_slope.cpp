#include "diagnose/ground_slope.hpp"

#include <algorithm>
#include <cstddef>

#include "core/row_bands.hpp"
#include "diagnose/words.hpp"

namespace d2b {

void add_slope(const MetreGrid& ground, const CellSize& cell, std::int32_t first_row, const Window& cells,
               GroundSlope& slope, Executor& threads) {
    constexpr std::int32_t every = 16;
    const auto end_col = static_cast<std::size_t>(std::min(cells.end_col(), ground.cols - 1));
    const auto add_row = [&](std::int32_t r, GroundSlope& sum) {
        const auto here = ground.row(r);
        const auto below = ground.row(r + 1);
        for (auto c = static_cast<std::size_t>(cells.col); c < end_col; ++c)
            sum.add(static_cast<double>(here[c + 1] - here[c]) / cell.across,
                    static_cast<double>(below[c] - here[c]) / cell.down);
    };
    const std::int32_t rows = std::min(cells.end_row(), ground.rows - 1) - cells.row;
    slope.merge(
        sum_of_row_bands(threads, rows, ground.cols, GroundSlope(), [&](RowBand band, GroundSlope& sum) {
            for (std::int32_t r = band.begin; r < band.end; ++r)
                if ((first_row + cells.row + r) % every == 0)
                    add_row(cells.row + r, sum);
        }));
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
