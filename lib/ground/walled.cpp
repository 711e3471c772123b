#include "ground/walled.hpp"

#include <algorithm>
#include <vector>

#include "ground/block_place.hpp"
#include "ground/line_pass.hpp"

namespace d2b::ground {
namespace {

/// Collects connected pieces of blocks and measures their surroundings.
class Pieces {
  public:
    Pieces(const AlignedGrid& blocks, const MetreGrid& limits, const Mask& ground)
        : blocks_(blocks),
          grid_(blocks.grid),
          open_(grid_.rows, grid_.cols),
          inside_(grid_.rows, grid_.cols) {
        for (std::size_t i = 0; i < ground.size(); ++i) {
            const float z = grid_.values[i];
            inside_.values[i] = ground.values[i] != 0 && z != no_value && z > limits.values[i] ? 1 : 0;
        }
        open_ = inside_;
    }

    /// Returns the piece that contains a block, or nothing if it was returned before.
    [[nodiscard]] std::vector<BlockPlace> take(BlockPlace first) {
        std::vector<BlockPlace> piece;
        add(first, piece);
        for (std::size_t i = 0; i < piece.size(); ++i)
            for (const BlockPlace& side : block_sides)
                add({piece[i].row + side.row, piece[i].col + side.col}, piece);
        return piece;
    }

    /// Returns the share of a piece's border at which the surface steps by more than `rise`: up or down in
    /// the next block, or down within two, because a wall may extend into a block.
    [[nodiscard]] double walled_share(const std::vector<BlockPlace>& piece, float rise) const {
        std::int64_t border = 0;
        std::int64_t walled = 0;
        for (const BlockPlace& at : piece)
            for (const BlockPlace& side : block_sides) {
                const BlockPlace beside{at.row + side.row, at.col + side.col};
                if (!grid_.holds(beside.row, beside.col))
                    ++border;  // the piece may continue beyond the raster
                if (!outside(beside))
                    continue;
                ++border;
                const BlockPlace behind{beside.row + side.row, beside.col + side.col};
                const float z = grid_.at(at.row, at.col);
                const float there = grid_.at(beside.row, beside.col);
                const float lower =
                    outside(behind) ? std::min(there, grid_.at(behind.row, behind.col)) : there;
                walled += there > z + rise || lower < z - rise ? 1 : 0;
            }
        return border > 0 ? static_cast<double>(walled) / static_cast<double>(border) : 0;
    }

    [[nodiscard]] double length(const std::vector<BlockPlace>& piece) const {
        const auto [top, bottom] =
            std::minmax_element(piece.begin(), piece.end(),
                                [](const BlockPlace& a, const BlockPlace& b) { return a.row < b.row; });
        const auto [left, right] =
            std::minmax_element(piece.begin(), piece.end(),
                                [](const BlockPlace& a, const BlockPlace& b) { return a.col < b.col; });
        return std::max((bottom->row - top->row + 1) * blocks_.cell.down,
                        (right->col - left->col + 1) * blocks_.cell.across);
    }

  private:
    void add(BlockPlace at, std::vector<BlockPlace>& piece) {
        if (!grid_.holds(at.row, at.col) || open_.at(at.row, at.col) == 0)
            return;
        open_.at(at.row, at.col) = 0;
        piece.push_back(at);
    }
    [[nodiscard]] bool outside(BlockPlace at) const {
        return grid_.holds(at.row, at.col) && inside_.at(at.row, at.col) == 0 &&
               grid_.at(at.row, at.col) != no_value;
    }

    const AlignedGrid& blocks_;
    const MetreGrid& grid_;
    Mask open_;
    Mask inside_;
};

}  // namespace

void take_walled_back(const AlignedGrid& blocks, const MetreGrid& limits, const Rules& rules, double largest,
                      Grid<std::uint8_t>& ground) {
    Pieces pieces(blocks, limits, ground);
    for (std::int32_t row = 0; row < ground.rows; ++row)
        for (std::int32_t col = 0; col < ground.cols; ++col) {
            const std::vector<BlockPlace> piece = pieces.take({row, col});
            if (piece.empty() || pieces.length(piece) > largest ||
                pieces.walled_share(piece, static_cast<float>(rules.wall_rise)) <= rules.wall_share)
                continue;
            for (const BlockPlace& at : piece)
                ground.at(at.row, at.col) = 0;
        }
}

}  // namespace d2b::ground
