#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ground/aligned_grid.hpp"
#include "ground/fill.hpp"

namespace d2b::ground {

/// Interpolates between the centres of blocks of 2 x 2 cells, the next coarser level.
class LevelAbove {
  public:
    LevelAbove(const AlignedGrid& fine, const AlignedGrid& coarse);

    /// Buffers reused between rows.
    struct Room {
        std::vector<float> blocks;
        std::vector<float> cells;
    };
    /// Fills the gaps in a row of the fine grid. @param gap 1 for cells without a value, else 0
    void fill_row(std::int32_t row, std::span<const std::uint8_t> gap, Room& room,
                  std::span<float> cells) const;

  private:
    void spread(Room& room) const;

    const MetreGrid& coarse_;
    Between down_;
    Between across_;
    std::size_t first_second_;  ///< first cell that is the second of its block
};

}  // namespace d2b::ground
