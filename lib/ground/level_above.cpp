#include "ground/level_above.hpp"

#include <algorithm>

#include "core/processors.hpp"
#include "ground/chosen.hpp"

namespace d2b::ground {
namespace {

/// Interpolates between the centres of blocks of two cells: for each pair of blocks, the cells at one and
/// three quarters of the distance.
D2B_FOR_EACH_PROCESSOR void between_centres(std::span<const float> blocks, float* cells) {
    for (std::size_t k = 0; k + 1 < blocks.size(); ++k) {
        const float near = blocks[k];
        const float step = blocks[k + 1] - near;
        cells[2 * k] = near + 0.25F * step;
        cells[2 * k + 1] = near + 0.75F * step;
    }
}

D2B_FOR_EACH_PROCESSOR void fill_where(std::span<const std::uint8_t> gap, std::span<const float> by,
                                       std::span<float> cells) {
    for (std::size_t j = 0; j < cells.size(); ++j)
        cells[j] = chosen(gap[j], by[j], cells[j]);
}

}  // namespace

LevelAbove::LevelAbove(const AlignedGrid& fine, const AlignedGrid& coarse)
    : coarse_(coarse.grid),
      down_(fine.first_row, fine.grid.rows, coarse.first_row, coarse.grid.rows, 2),
      across_(fine.first_col, fine.grid.cols, coarse.first_col, coarse.grid.cols, 2),
      first_second_(static_cast<std::size_t>(2 * coarse.first_col + 1 - fine.first_col)) {}

void LevelAbove::fill_row(std::int32_t row, std::span<const std::uint8_t> gap, Room& room,
                          std::span<float> cells) const {
    const auto near = coarse_.row(down_[row].near);
    const auto next = coarse_.row(down_[row].next);
    const float share = down_[row].share;
    room.blocks.resize(near.size());
    for (std::size_t k = 0; k < near.size(); ++k)
        room.blocks[k] = near[k] + share * (next[k] - near[k]);
    room.cells.resize(cells.size());
    spread(room);
    fill_where(gap, room.cells, cells);
}

/// Interpolates for all cells, including those with a value, because most are near a gap and the loop then
/// needs no branch.
void LevelAbove::spread(Room& room) const {
    const std::size_t pairs = std::min(room.blocks.size() - 1, (room.cells.size() - first_second_) / 2);
    between_centres(std::span(room.blocks).first(pairs + 1), room.cells.data() + first_second_);
    const auto place_cell = [&](std::size_t j) {
        const Between::Place& place = across_[static_cast<std::int32_t>(j)];
        const float a = room.blocks[static_cast<std::size_t>(place.near)];
        const float b = room.blocks[static_cast<std::size_t>(place.next)];
        room.cells[j] = a + place.share * (b - a);
    };
    // Cells before the centre of the first block and after that of the last.
    for (std::size_t j = 0; j < first_second_; ++j)
        place_cell(j);
    for (std::size_t j = first_second_ + 2 * pairs; j < room.cells.size(); ++j)
        place_cell(j);
}

}  // namespace d2b::ground
