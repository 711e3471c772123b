#include "ground/connect.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "ground/window_pass.hpp"

namespace d2b::ground {
namespace {

using Mask = Grid<std::uint8_t>;

/// From a block to one beside it.
struct Neighbour {
    std::int32_t down;
    std::int32_t across;
};
constexpr std::array<Neighbour, 8> all_neighbours{
    {{-1, -1}, {-1, 0}, {-1, 1}, {0, -1}, {0, 1}, {1, -1}, {1, 0}, {1, 1}}};

class Growth {
  public:
    Growth(const AlignedGrid& blocks, const MetreGrid& limits, double slope) : grid_(blocks.grid) {
        for (const Neighbour& n : all_neighbours)
            steps_.push_back(static_cast<float>(
                slope * std::hypot(n.down * blocks.cell.down, n.across * blocks.cell.across)));
        mask_ = Mask(grid_.rows, grid_.cols);
        for (std::int32_t i = 0; i < grid_.rows; ++i)
            for (std::int32_t j = 0; j < grid_.cols; ++j)
                if (grid_.at(i, j) != no_value && grid_.at(i, j) <= limits.at(i, j)) {
                    mask_.at(i, j) = 1;
                    front_.push_back({i, j});
                }
    }

    /// All blocks that join in this step touch one that joined in the last.
    void step() {
        std::vector<Place> joined;
        for (const Place& from : front_)
            for (std::size_t k = 0; k < steps_.size(); ++k) {
                const Place to{from.row + all_neighbours[k].down, from.col + all_neighbours[k].across};
                if (!grid_.holds(to.row, to.col) || mask_.at(to.row, to.col))
                    continue;
                const float z = grid_.at(to.row, to.col);
                if (z != no_value && std::fabs(z - grid_.at(from.row, from.col)) < steps_[k]) {
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
    const MetreGrid& grid_;
    std::vector<float> steps_;
    std::vector<Place> front_;
    Mask mask_;
};

}  // namespace

Grid<std::uint8_t> connected_ground(const AlignedGrid& blocks, const MetreGrid& limits, double slope,
                                    int steps) {
    Growth growth(blocks, limits, slope);
    for (int k = 0; k < steps && !growth.over(); ++k)
        growth.step();
    return growth.take();
}

}  // namespace d2b::ground
