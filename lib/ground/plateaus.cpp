#include "ground/plateaus.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ground/block_place.hpp"
#include "ground/line_pass.hpp"

namespace d2b::ground {
namespace {

enum Seen : std::uint8_t {
    not_seen,
    here,  ///< current plateau
    done
};

/// Traces plateaus, each once. The result does not depend on the block at which tracing starts.
class Plateaus {
  public:
    Plateaus(const AlignedGrid& blocks, const Rules& rules, double largest)
        : blocks_(blocks),
          grid_(blocks.grid),
          rules_(rules),
          largest_(largest),
          seen_(grid_.rows, grid_.cols),
          roofs_(grid_.rows, grid_.cols) {
        for (std::size_t k = 0; k < blocks_around.size(); ++k)
            rises_.at(k) = rules.link_slope * std::hypot(blocks_around.at(k).row * blocks.cell.down,
                                                         blocks_around.at(k).col * blocks.cell.across);
    }

    void look_at(BlockPlace first) {
        if (seen_.at(first.row, first.col) != not_seen)
            return;
        plateau_.clear();
        top_ = bottom_ = first.row;
        left_ = right_ = first.col;
        add(first);
        const bool is_roof = follow() && share_that_falls() > rules_.plateau_share;
        for (const BlockPlace& at : plateau_) {
            seen_.at(at.row, at.col) = done;
            roofs_.at(at.row, at.col) = is_roof ? 1 : 0;
        }
    }
    [[nodiscard]] Mask take() { return std::move(roofs_); }

  private:
    void add(BlockPlace at) {
        seen_.at(at.row, at.col) = here;
        plateau_.push_back(at);
        open_.push_back(at);
        top_ = std::min(top_, at.row);
        bottom_ = std::max(bottom_, at.row);
        left_ = std::min(left_, at.col);
        right_ = std::max(right_, at.col);
    }
    /// Returns true if the component is too long or reaches the border of the raster, beyond which it may
    /// continue.
    [[nodiscard]] bool may_be_ground() const {
        return top_ == 0 || left_ == 0 || bottom_ + 1 == grid_.rows || right_ + 1 == grid_.cols ||
               (bottom_ - top_ + 1) * blocks_.cell.down > largest_ ||
               (right_ - left_ + 1) * blocks_.cell.across > largest_;
    }
    /// Traces depth first, because that leaves a long plateau early. @return true if it was traced completely
    [[nodiscard]] bool follow() {
        bool ends = !may_be_ground();
        while (ends && !open_.empty()) {
            const BlockPlace at = open_.back();
            open_.pop_back();
            for (std::size_t k = 0; k < blocks_around.size(); ++k)
                ends = go(at, k) && ends;
            ends = ends && !may_be_ground();
        }
        open_.clear();
        return ends;
    }
    /// @param k index in blocks_around @return false if the neighbour belongs to a component that is not a
    /// roof
    [[nodiscard]] bool go(BlockPlace from, std::size_t k) {
        const BlockPlace step = blocks_around[k];
        const BlockPlace to{from.row + step.row, from.col + step.col};
        if (!is_known(to))
            return true;
        const auto rise =
            static_cast<double>(std::fabs(grid_.at(to.row, to.col) - grid_.at(from.row, from.col)));
        if (!(rise < rises_[k]))
            return true;
        if (seen_.at(to.row, to.col) == not_seen)
            add(to);
        return seen_.at(to.row, to.col) != done;
    }
    [[nodiscard]] bool is_known(BlockPlace at) const {
        return grid_.holds(at.row, at.col) && grid_.at(at.row, at.col) != no_value;
    }
    [[nodiscard]] bool is_beside(BlockPlace at) const {
        return is_known(at) && seen_.at(at.row, at.col) != here;
    }

    /// Share of the border of a plateau that drops by more than the height of a wall in the next block, or
    /// within two, because a wall may extend into a block.
    [[nodiscard]] double share_that_falls() const {
        std::int64_t border = 0;
        std::int64_t falls = 0;
        for (const BlockPlace& at : plateau_)
            for (const BlockPlace& side : block_sides) {
                const BlockPlace beside{at.row + side.row, at.col + side.col};
                if (!is_beside(beside))
                    continue;
                ++border;
                const BlockPlace behind{beside.row + side.row, beside.col + side.col};
                const float there = grid_.at(beside.row, beside.col);
                const float lower =
                    is_beside(behind) ? std::min(there, grid_.at(behind.row, behind.col)) : there;
                falls += lower < grid_.at(at.row, at.col) - static_cast<float>(rules_.wall_rise) ? 1 : 0;
            }
        return border > 0 ? static_cast<double>(falls) / static_cast<double>(border) : 0;
    }

    const AlignedGrid& blocks_;
    const MetreGrid& grid_;
    const Rules& rules_;
    double largest_;
    std::array<double, blocks_around.size()> rises_{};  ///< largest rise of ground, per neighbour
    Grid<std::uint8_t> seen_;
    Mask roofs_;
    std::vector<BlockPlace> plateau_;
    std::vector<BlockPlace> open_;
    std::int32_t top_ = 0;
    std::int32_t bottom_ = 0;
    std::int32_t left_ = 0;
    std::int32_t right_ = 0;
};

}  // namespace

Mask walled_plateaus(const AlignedGrid& blocks, const MetreGrid& limits, const Mask& ground,
                     const Rules& rules, double largest) {
    Plateaus plateaus(blocks, rules, largest);
    for (std::int32_t row = 0; row < ground.rows; ++row)
        for (std::int32_t col = 0; col < ground.cols; ++col) {
            const float z = blocks.grid.at(row, col);
            if (ground.at(row, col) != 0 && z != no_value && z > limits.at(row, col))
                plateaus.look_at({row, col});
        }
    return plateaus.take();
}

}  // namespace d2b::ground
