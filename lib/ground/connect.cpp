#include "ground/connect.hpp"

#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "core/row_bands.hpp"
#include "ground/line_pass.hpp"

namespace d2b::ground {
namespace {

/// Offset of a neighbouring block.
struct Neighbour {
    std::int32_t down;
    std::int32_t across;
};
constexpr std::array<Neighbour, 8> all_neighbours{
    {{-1, -1}, {-1, 0}, {-1, 1}, {0, -1}, {0, 1}, {1, -1}, {1, 0}, {1, 1}}};

class Growth {
  public:
    Growth(const AlignedGrid& blocks, const MetreGrid& limits, double slope, Executor& threads)
        : grid_(blocks.grid), mask_(Mask::unset(grid_.rows, grid_.cols, threads)) {
        for (const Neighbour& n : all_neighbours)
            steps_.push_back(static_cast<float>(
                slope * std::hypot(n.down * blocks.cell.down, n.across * blocks.cell.across)));
        for_row_bands(threads, grid_.rows, grid_.cols, [&](RowBand band) {
            for (std::int32_t i = band.begin; i < band.end; ++i) {
                const std::span<const float> z = grid_.row(i);
                const std::span<const float> limit = limits.row(i);
                const std::span<std::uint8_t> out = mask_.row(i);
                for (std::size_t j = 0; j < out.size(); ++j)
                    out[j] =
                        static_cast<std::uint8_t>((z[j] != no_value ? 1 : 0) & (z[j] <= limit[j] ? 1 : 0));
            }
        });
    }

    /// Finds the first blocks that join. Searches from non-ground to ground, because most blocks are ground
    /// at the start.
    void first_step(Executor& threads) {
        const std::vector<RowBand> bands = row_bands(grid_.rows, grid_.cols);
        std::vector<std::vector<Place>> joined(bands.size());
        threads.for_each(bands.size(), [&](std::size_t band) {
            for (std::int32_t i = bands[band].begin; i < bands[band].end; ++i)
                for (std::int32_t j = 0; j < grid_.cols; ++j)
                    if (mask_.at(i, j) == 0 && grid_.at(i, j) != no_value && touches_ground({i, j}))
                        joined[band].push_back({i, j});
        });
        for (const std::vector<Place>& some : joined)
            front_.insert(front_.end(), some.begin(), some.end());
        for (const Place& place : front_)
            mask_.at(place.row, place.col) = 1;
    }

    /// Adds all blocks that touch one added in the previous step.
    void step() {
        std::vector<Place> joined;
        for (const Place& from : front_)
            for (std::size_t k = 0; k < steps_.size(); ++k) {
                const Place to{from.row + all_neighbours[k].down, from.col + all_neighbours[k].across};
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
    struct Place {
        std::int32_t row;
        std::int32_t col;
    };

    [[nodiscard]] bool is_step(const Place& from, const Place& to, std::size_t k) const {
        const float z = grid_.at(to.row, to.col);
        return z != no_value && std::fabs(z - grid_.at(from.row, from.col)) < steps_[k];
    }
    [[nodiscard]] bool touches_ground(const Place& at) const {
        for (std::size_t k = 0; k < steps_.size(); ++k) {
            const Place from{at.row + all_neighbours[k].down, at.col + all_neighbours[k].across};
            if (grid_.holds(from.row, from.col) && mask_.at(from.row, from.col) != 0 && is_step(from, at, k))
                return true;
        }
        return false;
    }

    const MetreGrid& grid_;
    std::vector<float> steps_;
    std::vector<Place> front_;
    Mask mask_;
};

}  // namespace

Grid<std::uint8_t> connected_ground(const AlignedGrid& blocks, const MetreGrid& limits, double slope,
                                    int steps, Executor& threads) {
    Growth growth(blocks, limits, slope, threads);
    if (steps > 0)
        growth.first_step(threads);
    for (int k = 1; k < steps && !growth.over(); ++k)
        growth.step();
    return growth.take();
}

}  // namespace d2b::ground
