#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/stop_request.hpp"
#include "levels/building_cells.hpp"

namespace d2b {

/// Visits the cells of a building in scan order with their preceding neighbours. Holds two rows that move
/// down the building's columns.
class CellNeighbours {
  public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// @param stop checked at each run, because one building may fill a whole raster
    CellNeighbours(const BuildingCells& cells, const StopRequest& stop) : cells_(cells), stop_(stop) {
        std::int32_t end = 0;
        for (const BuildingCells::Run& run : cells.runs) {
            first_ = std::min(first_, run.begin);
            end = std::max(end, run.end);
        }
        above_.resize(cells.runs.empty() ? 0 : static_cast<std::size_t>(end - first_));
    }

    /// Calls use(cell, left, up, up_left) with the indices of cells in scan order, or `none`.
    template <typename Use>
    void for_each(const Use& use) {
        std::uint32_t cell = 0;
        for (const BuildingCells::Run& run : cells_.runs) {
            stop_.check();
            std::uint32_t left = none;
            std::uint32_t up_left = run.begin > first_ ? above(run.row, run.begin - 1) : none;
            for (std::int32_t col = run.begin; col < run.end; ++col, ++cell) {
                const std::uint32_t up = above(run.row, col);
                use(cell, left, up, up_left);
                Seen& here = above_[static_cast<std::size_t>(col - first_)];
                here = {run.row, cell, here.row, here.cell};
                left = cell;
                up_left = up;
            }
        }
    }

  private:
    /// Last two cells of a column.
    struct Seen {
        std::int32_t row = std::numeric_limits<std::int32_t>::min();
        std::uint32_t cell = none;
        std::int32_t row_before = std::numeric_limits<std::int32_t>::min();
        std::uint32_t cell_before = none;
    };
    [[nodiscard]] std::uint32_t above(std::int32_t row, std::int32_t col) const {
        const Seen& seen = above_[static_cast<std::size_t>(col - first_)];
        if (seen.row == row - 1)
            return seen.cell;
        return seen.row == row && seen.row_before == row - 1 ? seen.cell_before : none;
    }

    const BuildingCells& cells_;
    const StopRequest& stop_;
    std::int32_t first_ = std::numeric_limits<std::int32_t>::max();
    std::vector<Seen> above_;
};

}  // namespace d2b
