#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ground/aligned_grid.hpp"
#include "ground/fill.hpp"

namespace d2b::ground {

/// A level of blocks of 2 x 2 cells, between the centres of the blocks.
class LevelAbove {
  public:
    LevelAbove(const AlignedGrid& fine, const AlignedGrid& coarse);

    /// Kept from one row to the next, so that memory is asked for once.
    struct Room {
        std::vector<float> blocks;
        std::vector<float> cells;
    };
    /// Fills the gaps of a row of the fine grid. @param gap 1 where a cell has no value, else 0
    void fill_row(std::int32_t row, std::span<const std::uint8_t> gap, Room& room,
                  std::span<float> cells) const;

  private:
    void spread(Room& room) const;

    const MetreGrid& coarse_;
    Between down_;
    Between across_;
    std::size_t first_second_;  ///< the first cell that is the second of its block
};

}  // namespace d2b::ground
