#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"

namespace d2b {

/// Histogram of the heights of a surface above its ground. Integer counts, so the order does not matter.
class GroundFit {
  public:
    /// @param min_height height in m; cells higher above the ground are buildings, plants and the like, the
    /// others are bare
    explicit GroundFit(double min_height) : min_height_(static_cast<float>(min_height)) {}

    /// Adds the cells with both a surface and a ground.
    /// @param surface, ground elevations of the same cells in m
    void add(std::span<const float> surface, std::span<const float> ground);
    void merge(const GroundFit& other);

    [[nodiscard]] std::int64_t cells() const { return cells_; }
    [[nodiscard]] double min_height() const { return static_cast<double>(min_height_); }
    /// Shares of the cells; 1 and 0 if there are none. The resolution is a quarter of a metre.
    [[nodiscard]] double bare_share() const;
    [[nodiscard]] double share_above(double height) const;
    /// Medians of the heights of all cells and of the bare ones in m, to an eighth if within 500 m; NaN if
    /// there are no such cells.
    [[nodiscard]] double median() const { return middle(cells_); }
    [[nodiscard]] double bare_median() const { return middle(bare_); }

  private:
    static constexpr double bin_m = 0.25;
    static constexpr double highest_m = 500;
    static constexpr std::size_t bins = 4000;
    static constexpr std::int32_t unknown = -1;
    [[nodiscard]] static std::int32_t bin_of(double height);
    /// Finds the bins of cells, and counts the valid and the bare ones.
    void find_bins(std::span<const float> surface, std::span<const float> ground,
                   std::span<std::int32_t> found);
    /// Returns the median of the lowest `cells` cells.
    [[nodiscard]] double middle(std::int64_t cells) const;

    float min_height_;
    std::int64_t cells_ = 0;
    std::int64_t bare_ = 0;
    std::array<std::int64_t, bins> counts_{};  ///< the first and last bins include all values beyond them
};

/// Adds the heights of a surface above a ground in a part of the grids.
/// @param cells part of the grids
void add_fit(const MetreGrid& surface, const MetreGrid& ground, const Window& cells, GroundFit& fit,
             Executor& threads);

/// Number of steep cells of a ground. Integer counts, so the order does not matter.
struct GroundSlope {
    static constexpr double steep = 0.4;  ///< rise over run

    std::int64_t cells = 0;
    std::int64_t steep_cells = 0;

    /// Adds a cell with its slopes along the row and the column; NaN if unknown.
    void add(double across, double down) {
        // Compares squares first, because that mostly saves the square root.
        constexpr double far_off = 1e-9;
        const double square = across * across + down * down;
        if (square < steep * steep * (1 - far_off)) {
            ++cells;
            return;
        }
        const double slope = std::hypot(across, down);
        if (std::isnan(slope))
            return;
        ++cells;
        steep_cells += slope > steep ? 1 : 0;
    }
    void merge(const GroundSlope& other) {
        cells += other.cells;
        steep_cells += other.steep_cells;
    }
};

/// Adds the slopes of a ground in every sixteenth row of the window.
/// @param first_row row of the grid in the window
/// @param cells part of the grid
void add_slope(const MetreGrid& ground, const CellSize& cell, std::int32_t first_row, const Window& cells,
               GroundSlope& slope, Executor& threads);

/// Returns a warning if most of the ground is steep. A clause without a full stop; "" if it is not.
[[nodiscard]] std::string slope_warning(const GroundSlope& slope, const std::string& dem);

/// Returns the reason why a ground cannot be right, and possible remedies: the surface lies more than 2 m
/// above or below it on bare cells, or fewer than 5 % of the cells are bare. A clause without a full stop; ""
/// if the ground is plausible.
/// @param fit fit of the surface to the given or estimated ground or, for GroundMode::none, to 0
/// @param terrain name of the given terrain
[[nodiscard]] std::string ground_warning(const GroundFit& fit, GroundMode mode, const std::string& terrain);

/// Returns the reason why a raster may not be a surface model: hardly anything rises above its ground. "" if
/// enough does.
/// @param dem name of the raster
[[nodiscard]] std::string surface_warning(const GroundFit& fit, const std::string& dem);

}  // namespace d2b
