#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// How high a surface lies above its ground, as counts of cells: they add up whatever their order.
class GroundFit {
  public:
    /// @param min_height metres: what rises above the ground by more is a building, a plant or the like; the
    /// other cells are bare
    explicit GroundFit(double min_height) : min_height_(static_cast<float>(min_height)) {}

    /// Counts the cells of which both are known. @param surface, ground elevations of the same cells, m
    void add(std::span<const float> surface, std::span<const float> ground);
    void merge(const GroundFit& other);

    [[nodiscard]] std::int64_t cells() const { return cells_; }
    [[nodiscard]] double min_height() const { return static_cast<double>(min_height_); }
    /// Shares of the cells; 1 and 0 where there are none. Heights are told apart in quarters of a metre.
    [[nodiscard]] double bare_share() const;
    [[nodiscard]] double share_above(double height) const;
    /// Medians of the heights of all cells and of the bare ones, metres, to an eighth where they are within
    /// 500; NaN where there are no such cells.
    [[nodiscard]] double median() const { return middle(cells_); }
    [[nodiscard]] double bare_median() const { return middle(bare_); }

  private:
    static constexpr double bin_m = 0.25;
    static constexpr double highest_m = 500;
    static constexpr std::size_t bins = 4000;
    static constexpr std::int32_t unknown = -1;
    [[nodiscard]] static std::int32_t bin_of(double height);
    /// The bins of some cells. Counts those that are known and those that are bare.
    void find_bins(std::span<const float> surface, std::span<const float> ground,
                   std::span<std::int32_t> found);
    /// The median of so many cells from the lowest on.
    [[nodiscard]] double middle(std::int64_t cells) const;

    float min_height_;
    std::int64_t cells_ = 0;
    std::int64_t bare_ = 0;
    std::array<std::int64_t, bins> counts_{};  ///< the first and the last hold what lies beyond them as well
};

/// Adds how a surface lies above a ground in some of its cells. @param cells of the grids
void add_fit(const MetreGrid& surface, const MetreGrid& ground, const Window& cells, GroundFit& fit,
             Executor& threads);

}  // namespace d2b
