#include "ground/connected_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/grid.hpp"
#include "raster/plane_sums.hpp"
#include "raster/rank_filter.hpp"
#include "raster/regions.hpp"

namespace d2b::ground {

/// Position of a block, or offset between two blocks.
struct BlockIndex {
    std::int32_t row;
    std::int32_t col;
};

inline constexpr std::array<BlockIndex, 4> neighbours_4{{{-1, 0}, {0, -1}, {0, 1}, {1, 0}}};
inline constexpr std::array<BlockIndex, 8> neighbours_8{
    {{-1, -1}, {-1, 0}, {-1, 1}, {0, -1}, {0, 1}, {1, -1}, {1, 0}, {1, 1}}};

namespace {

class RegionGrowing {
  public:
    RegionGrowing(const AlignedGrid& blocks, const MetreGrid& limits, double slope, Executor& threads)
        : grid_(blocks.grid), mask_(Mask::unset(grid_.rows, grid_.cols, threads)) {
        for (const BlockIndex& n : neighbours_8)
            steps_.push_back(
                static_cast<float>(slope * std::hypot(n.row * blocks.cell.down, n.col * blocks.cell.across)));
        for_rows(threads, grid_.rows, grid_.cols, [&](std::int32_t i) {
            const std::span<const float> z = grid_.row(i);
            const std::span<const float> limit = limits.row(i);
            const std::span<std::uint8_t> out = mask_.row(i);
            for (std::size_t j = 0; j < out.size(); ++j)
                out[j] = static_cast<std::uint8_t>((z[j] != no_value ? 1 : 0) & (z[j] <= limit[j] ? 1 : 0));
        });
    }

    /// Finds the first blocks that join. Searches from non-ground to ground, because most blocks are ground
    /// at the start.
    void first_step(Executor& threads) {
        const std::vector<RowBand> bands = row_bands(grid_.rows, grid_.cols);
        std::vector<std::vector<BlockIndex>> joined(bands.size());
        threads.for_each(bands.size(), [&](std::size_t band) {
            for (std::int32_t i = bands[band].begin; i < bands[band].end; ++i)
                for (std::int32_t j = 0; j < grid_.cols; ++j)
                    if (mask_.at(i, j) == 0 && grid_.at(i, j) != no_value && touches_ground({i, j}))
                        joined[band].push_back({i, j});
        });
        for (const std::vector<BlockIndex>& some : joined)
            front_.insert(front_.end(), some.begin(), some.end());
        for (const BlockIndex& place : front_)
            mask_.at(place.row, place.col) = 1;
    }

    /// Adds all blocks that touch one added in the previous step.
    void step() {
        std::vector<BlockIndex> joined;
        for (const BlockIndex& from : front_)
            for (std::size_t k = 0; k < steps_.size(); ++k) {
                const BlockIndex to{from.row + neighbours_8[k].row, from.col + neighbours_8[k].col};
                if (grid_.holds(to.row, to.col) && mask_.at(to.row, to.col) == 0 && is_step(from, to, k)) {
                    mask_.at(to.row, to.col) = 1;
                    joined.push_back(to);
                }
            }
        front_ = std::move(joined);
    }

    [[nodiscard]] bool over() const { return front_.empty(); }
    [[nodiscard]] Mask take() { return std::move(mask_); }

  private:
    [[nodiscard]] bool is_step(const BlockIndex& from, const BlockIndex& to, std::size_t k) const {
        const float z = grid_.at(to.row, to.col);
        return z != no_value && std::fabs(z - grid_.at(from.row, from.col)) < steps_[k];
    }
    [[nodiscard]] bool touches_ground(const BlockIndex& at) const {
        for (std::size_t k = 0; k < steps_.size(); ++k) {
            const BlockIndex from{at.row + neighbours_8[k].row, at.col + neighbours_8[k].col};
            if (grid_.holds(from.row, from.col) && mask_.at(from.row, from.col) != 0 && is_step(from, at, k))
                return true;
        }
        return false;
    }

    const MetreGrid& grid_;
    std::vector<float> steps_;
    std::vector<BlockIndex> front_;
    Mask mask_;
};

/// Border of a component of blocks, counted by sides of blocks, and its plane.
struct BorderSides {
    std::int64_t within = 0;  ///< sides within the raster
    std::int64_t beyond = 0;  ///< sides at its border, beyond which the component may continue
    std::int64_t walled = 0;
    PlaneSums plane;

    [[nodiscard]] double walled_share() const { return share_of(within + beyond); }
    /// Ignores the border of the raster, because it cuts roofs; 0 if half of the sides or more are there.
    [[nodiscard]] double walled_share_within() const { return beyond < within ? share_of(within) : 0; }

  private:
    [[nodiscard]] double share_of(std::int64_t sides) const {
        return sides > 0 ? static_cast<double>(walled) / static_cast<double>(sides) : 0;
    }
};

/// Counts the sides at which the surface steps by more than `rise`: up or down in the next block, or down
/// within two, because a wall may extend into a block.
std::vector<BorderSides> border_sides(const AlignedGrid& blocks, const Mask& inside,
                                      const Regions& components, float rise) {
    const MetreGrid& grid = blocks.grid;
    const auto is_outside = [&](BlockIndex at) {
        return grid.holds(at.row, at.col) && inside.at(at.row, at.col) == 0 &&
               grid.at(at.row, at.col) != no_value;
    };
    std::vector<BorderSides> borders(components.cells.size());
    const auto add = [&](BlockIndex at, BorderSides& border) {
        for (const BlockIndex& side : neighbours_4) {
            const BlockIndex beside{at.row + side.row, at.col + side.col};
            if (!grid.holds(beside.row, beside.col))
                ++border.beyond;
            if (!is_outside(beside))
                continue;
            ++border.within;
            const BlockIndex behind{beside.row + side.row, beside.col + side.col};
            const float z = grid.at(at.row, at.col);
            const float there = grid.at(beside.row, beside.col);
            const float lower = is_outside(behind) ? std::min(there, grid.at(behind.row, behind.col)) : there;
            border.walled += there > z + rise || lower < z - rise ? 1 : 0;
        }
    };
    for (std::int32_t r = 0; r < components.rows; ++r)
        for (const RegionRun& run : components.row(r))
            for (std::int32_t c = run.begin; c < run.end; ++c) {
                add({r, c}, borders[run.label]);
                borders[run.label].plane.add(r, c, grid.at(r, c), blocks.cell);
            }
    return borders;
}

enum VisitState : std::uint8_t {
    unvisited,
    current,  ///< current plateau
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
          state_(grid_.rows, grid_.cols),
          roofs_(grid_.rows, grid_.cols) {
        for (std::size_t k = 0; k < neighbours_8.size(); ++k)
            rises_.at(k) = rules.link_slope * std::hypot(neighbours_8.at(k).row * blocks.cell.down,
                                                         neighbours_8.at(k).col * blocks.cell.across);
    }

    void trace_from(BlockIndex first) {
        if (state_.at(first.row, first.col) != unvisited)
            return;
        plateau_.clear();
        top_ = bottom_ = first.row;
        left_ = right_ = first.col;
        add(first);
        const bool is_roof = trace() && drop_share() > rules_.plateau_share;
        for (const BlockIndex& at : plateau_) {
            state_.at(at.row, at.col) = done;
            roofs_.at(at.row, at.col) = is_roof ? 1 : 0;
        }
    }
    [[nodiscard]] Mask take() { return std::move(roofs_); }

  private:
    void add(BlockIndex at) {
        state_.at(at.row, at.col) = current;
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
    [[nodiscard]] bool trace() {
        bool ends = !may_be_ground();
        while (ends && !open_.empty()) {
            const BlockIndex at = open_.back();
            open_.pop_back();
            for (std::size_t k = 0; k < neighbours_8.size(); ++k)
                ends = visit(at, k) && ends;
            ends = ends && !may_be_ground();
        }
        open_.clear();
        return ends;
    }
    /// @param k index in neighbours_8 @return false if the neighbour belongs to a component that is not a
    /// roof
    [[nodiscard]] bool visit(BlockIndex from, std::size_t k) {
        const BlockIndex step = neighbours_8[k];
        const BlockIndex to{from.row + step.row, from.col + step.col};
        if (!is_known(to))
            return true;
        const auto rise =
            static_cast<double>(std::fabs(grid_.at(to.row, to.col) - grid_.at(from.row, from.col)));
        if (!(rise < rises_[k]))
            return true;
        if (state_.at(to.row, to.col) == unvisited)
            add(to);
        return state_.at(to.row, to.col) != done;
    }
    [[nodiscard]] bool is_known(BlockIndex at) const {
        return grid_.holds(at.row, at.col) && grid_.at(at.row, at.col) != no_value;
    }
    [[nodiscard]] bool is_beside(BlockIndex at) const {
        return is_known(at) && state_.at(at.row, at.col) != current;
    }

    /// Share of the border of a plateau that drops by more than the height of a wall in the next block, or
    /// within two, because a wall may extend into a block.
    [[nodiscard]] double drop_share() const {
        std::int64_t border = 0;
        std::int64_t falls = 0;
        for (const BlockIndex& at : plateau_)
            for (const BlockIndex& side : neighbours_4) {
                const BlockIndex beside{at.row + side.row, at.col + side.col};
                if (!is_beside(beside))
                    continue;
                ++border;
                const BlockIndex behind{beside.row + side.row, beside.col + side.col};
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
    std::array<double, neighbours_8.size()> rises_{};  ///< largest rise of ground, per neighbour
    Grid<std::uint8_t> state_;
    Mask roofs_;
    std::vector<BlockIndex> plateau_;
    std::vector<BlockIndex> open_;
    std::int32_t top_ = 0;
    std::int32_t bottom_ = 0;
    std::int32_t left_ = 0;
    std::int32_t right_ = 0;
};

}  // namespace

Grid<std::uint8_t> connected_ground(const AlignedGrid& blocks, const MetreGrid& limits, double slope,
                                    int steps, Executor& threads) {
    RegionGrowing region(blocks, limits, slope, threads);
    if (steps > 0)
        region.first_step(threads);
    for (int k = 1; k < steps && !region.over(); ++k)
        region.step();
    return region.take();
}

void remove_enclosed_by_walls(const AlignedGrid& blocks, const MetreGrid& limits, const Rules& rules,
                              double largest, Mask& ground, Executor& threads) {
    const MetreGrid& grid = blocks.grid;
    Mask inside(grid.rows, grid.cols);
    for (std::size_t i = 0; i < ground.size(); ++i) {
        const float z = grid.values[i];
        inside.values[i] = ground.values[i] != 0 && z != no_value && z > limits.values[i] ? 1 : 0;
    }
    const Regions components = connected_regions(inside, 1, 0, threads);
    const std::vector<CellBox> boxes = bounding_boxes(components);
    const std::vector<BorderSides> borders =
        border_sides(blocks, inside, components, static_cast<float>(rules.wall_rise));
    const auto is_level = [&](Label label) {
        return static_cast<double>(components.cells[label]) * blocks.cell.area() >= rules.level_area &&
               borders[label].plane.tilt() < rules.level_slope;
    };
    const auto is_enclosed = [&](Label label) {
        const BorderSides& border = borders[label];
        return std::max(boxes[label].rows() * blocks.cell.down, boxes[label].cols() * blocks.cell.across) <=
                   largest &&
               (border.walled_share() > rules.wall_share ||
                (is_level(label) && border.walled_share_within() > rules.level_share));
    };
    paint(components, is_enclosed, 0, ground, threads);
}

Mask enclosed_plateaus(const AlignedGrid& blocks, const MetreGrid& limits, const Mask& ground,
                       const Rules& rules, double largest) {
    Plateaus plateaus(blocks, rules, largest);
    for (std::int32_t row = 0; row < ground.rows; ++row)
        for (std::int32_t col = 0; col < ground.cols; ++col) {
            const float z = blocks.grid.at(row, col);
            if (ground.at(row, col) != 0 && z != no_value && z > limits.at(row, col))
                plateaus.trace_from({row, col});
        }
    return plateaus.take();
}

}  // namespace d2b::ground
