#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// How much of a ground is steep, as counts of cells: they add up whatever their order.
struct GroundSlope {
    static constexpr double steep = 0.4;  ///< rise over run

    std::int64_t cells = 0;
    std::int64_t steep_cells = 0;

    /// A cell with its slopes along the row and the column; NaN where one is not known.
    void add(double across, double down) {
        // Mostly their squares tell, without a root.
        constexpr double far_off = 1e-9;
        const double square = across * across + down * down;
        if (square < steep * steep * (1 - far_off)) {
            ++cells;
            return;
        }
        const double slope = std::hypot(across, down);
        if (std::isnan(slope))
            return;
        ++cells;
        steep_cells += slope > steep ? 1 : 0;
    }
    void merge(const GroundSlope& other) {
        cells += other.cells;
        steep_cells += other.steep_cells;
    }
};

/// Adds the slopes of a ground in every sixteenth of the window's rows. @param first_row of the grid in the
/// window @param cells of the grid
void add_slope(const MetreGrid& ground, const CellSize& cell, std::int32_t first_row, const Window& cells,
               GroundSlope& slope, Executor& threads);

/// Where most of the ground is steep. Without a full stop; "" where it is not.
[[nodiscard]] std::string slope_doubt(const GroundSlope& slope, const std::string& dem);

}  // namespace d2b
