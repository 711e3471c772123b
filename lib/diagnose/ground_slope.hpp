#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Number of steep cells of a ground. Integer counts, so the order does not matter.
struct GroundSlope {
    static constexpr double steep = 0.4;  ///< rise over run

    std::int64_t cells = 0;
    std::int64_t steep_cells = 0;

    /// Adds a cell with its slopes along the row and the column; NaN if unknown.
    void add(double across, double down) {
        // Compares squares first, because that mostly saves the square root.
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

/// Adds the slopes of a ground in every sixteenth row of the window.
/// @param first_row row of the grid in the window
/// @param cells part of the grid
void add_slope(const MetreGrid& ground, const CellSize& cell, std::int32_t first_row, const Window& cells,
               GroundSlope& slope, Executor& threads);

/// Returns a warning if most of the ground is steep. A clause without a full stop; "" if it is not.
[[nodiscard]] std::string slope_doubt(const GroundSlope& slope, const std::string& dem);

}  // namespace d2b
