#include "diagnose/parcel_shift.hpp"

#include <algorithm>
#include <cmath>

#include "core/row_bands.hpp"
#include "detect/roof_step.hpp"

namespace d2b {
namespace {

constexpr double step_m = 0.5;
constexpr double reach_m = 6;
constexpr std::int32_t least_reach = 3;  // minimum number of steps if cells are large

/// Wall score of edges between cells and their right or lower neighbours: 2 on a wall, 1 at most a step (half
/// steps included) next to one, else 0.
class WallGrid {
  public:
    WallGrid(const Scene& scene, const Detection& detection, bool below, std::int32_t step,
             Executor& threads);
    /// @pre the cell is in the grid
    [[nodiscard]] std::int64_t at(std::int32_t r, std::int32_t c) const { return weights_.at(r, c); }

  private:
    [[nodiscard]] bool is_building(std::int32_t r, std::int32_t c) const {
        return detection_.is_building(detection_.labels.at(r, c));
    }
    [[nodiscard]] bool is_wall(std::int32_t r, std::int32_t c) const;
    void weigh(std::int32_t r, std::int32_t c, std::int32_t step);

    const Scene& scene_;
    const Detection& detection_;
    float least_step_;
    std::int32_t down_;
    std::int32_t right_;
    Mask weights_;
};

WallGrid::WallGrid(const Scene& scene, const Detection& detection, bool below, std::int32_t step,
                   Executor& threads)
    : scene_(scene),
      detection_(detection),
      least_step_(walls_to_steps * roof_step(scene)),
      down_(below ? 1 : 0),
      right_(below ? 0 : 1),
      weights_(scene.surface.rows, scene.surface.cols) {
    for_row_bands(threads, weights_.rows, weights_.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r)
            for (std::int32_t c = 0; c < weights_.cols; ++c)
                weigh(r, c, step);
    });
}

bool WallGrid::is_wall(std::int32_t r, std::int32_t c) const {
    const std::int32_t to_r = r + down_;
    const std::int32_t to_c = c + right_;
    if (!weights_.holds(r, c) || !weights_.holds(to_r, to_c))
        return false;
    if (is_building(r, c) != is_building(to_r, to_c))
        return true;
    return is_building(r, c) &&
           std::abs(scene_.surface.at(r, c) - scene_.surface.at(to_r, to_c)) > least_step_;
}

void WallGrid::weigh(std::int32_t r, std::int32_t c, std::int32_t step) {
    for (std::int32_t beside = 0; beside <= step; ++beside)
        for (const std::int32_t away : {-beside, beside})
            if (is_wall(r + away * down_, c + away * right_)) {
                weights_.at(r, c) = 2 * beside <= step ? 2 : 1;
                return;
            }
}

/// Edges between cells and their right, or lower, neighbours.
class EdgeCounter {
  public:
    EdgeCounter(const Scene& scene, const Detection& detection, bool below, Executor& threads)
        : parcels_(*scene.parcels),
          below_(below),
          down_(shift_steps(scene.cell.down)),
          right_(shift_steps(scene.cell.across)),
          walls_(scene, detection, below, below ? down_.cells : right_.cells, threads) {}

    /// Adds the scores after each move if parcels separate the cell from its neighbour.
    void count(std::int32_t r, std::int32_t c, ShiftCounts& sum) const {
        const std::int32_t to_r = r + (below_ ? 1 : 0);
        const std::int32_t to_c = c + (below_ ? 0 : 1);
        if (!parcels_.holds(to_r, to_c) || !parted(parcels_.at(r, c), parcels_.at(to_r, to_c), below_))
            return;
        for (std::int32_t d = -down_.reach; d <= down_.reach; ++d)
            if (const std::int32_t row = r + d * down_.cells; row >= 0 && row < parcels_.rows)
                count_row(row, c, &sum.on_walls[ShiftCounts::index(d, -right_.reach)]);
    }

  private:
    void count_row(std::int32_t row, std::int32_t c, std::int64_t* to) const {
        for (std::int32_t i = -right_.reach; i <= right_.reach; ++i, ++to)
            if (const std::int32_t col = c + i * right_.cells; col >= 0 && col < parcels_.cols)
                *to += walls_.at(row, col);
    }

    const ParcelGrid& parcels_;
    bool below_;
    ShiftSteps down_;
    ShiftSteps right_;
    WallGrid walls_;
};

}  // namespace

ShiftSteps shift_steps(double cell_m) {
    const auto cells = std::max<std::int32_t>(1, static_cast<std::int32_t>(std::lround(step_m / cell_m)));
    const auto reach = static_cast<std::int32_t>(reach_m / (cells * cell_m));
    return {cells, std::clamp(reach, least_reach, ShiftCounts::most)};
}

void ShiftCounts::merge(const ShiftCounts& other) {
    for (std::size_t i = 0; i < on_walls.size(); ++i)
        on_walls[i] += other.on_walls[i];
}

void count_shifts(const Scene& scene, const Detection& detection, const Window& own, ShiftCounts& counts,
                  Executor& threads) {
    for (const bool below : {false, true}) {
        const EdgeCounter counter(scene, detection, below, threads);
        counts.merge(
            sum_of_row_bands(threads, own.rows, own.cols, ShiftCounts(), [&](RowBand band, ShiftCounts& sum) {
                for (std::int32_t r = own.row + band.begin; r < own.row + band.end; ++r)
                    for (std::int32_t c = own.col; c < own.end_col(); ++c)
                        counter.count(r, c, sum);
            }));
    }
}

}  // namespace d2b
