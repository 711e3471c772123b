#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "detect/parcel_fit.hpp"
#include "detect/scene.hpp"
#include "detect/surface_sampling.hpp"

namespace d2b::detect {

/// Histogram of the heights of a surface above its ground. Integer counts, so the order does not matter.
class GroundFit {
  public:
    /// @param min_height height in m; cells higher above the ground are buildings, plants and the like, the
    /// others are bare
    explicit GroundFit(double min_height = 0) : min_height_(static_cast<float>(min_height)) {}

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

/// Counts valid cells in islands surrounded by NoData and as wide as buildings, as in a raster of buildings
/// with NoData as ground. Integer counts, so the order does not matter.
struct ValidIslands {
    std::int64_t cells = 0;    ///< valid cells
    std::int64_t narrow = 0;   ///< of these, cells in pieces as large and as narrow as buildings
    std::int64_t islands = 0;  ///< number of such pieces
    std::int64_t largest = 0;  ///< cells of the largest one

    void merge(const ValidIslands& other);
    /// True if most valid cells are in narrow pieces.
    [[nodiscard]] bool narrow_most() const { return 2 * narrow > cells; }
};

/// Adds the pieces of a unit's core. If nearly all of its cells are valid, only their number is added.
/// @param own core cells of the unit
/// @param min_area_m2 minimum area of a building
/// @param max_width_m maximum width of a building
void add_islands(const MetreGrid& surface, const CellSize& cell, const Window& own, double min_area_m2,
                 double max_width_m, ValidIslands& islands, Executor& threads);

/// Flags of auxiliary rasters with at least one value at a valid cell of the DEM; true if a raster was not
/// given.
struct AuxiliaryCoverage {
    bool terrain = true;
    bool mask = true;
    bool ndvi = true;

    /// Merges the flags of two parts.
    void merge(const AuxiliaryCoverage& other) {
        terrain = terrain || other.terrain;
        mask = mask || other.mask;
        ndvi = ndvi || other.ndvi;
    }
};

/// Statistics of a search for buildings in a unit, a tile or the window. All are counts of cells, so parts
/// add up to the whole in any order.
struct SceneStatistics {
    SceneStatistics() = default;
    /// @param min_height see GroundFit
    explicit SceneStatistics(double min_height) : fit(min_height) {}
    /// Adds a ground before it is clamped to the surface. @param first_row, own see add_slope()
    void add_ground(const MetreGrid& surface, const MetreGrid& ground, const CellSize& cell,
                    std::int32_t first_row, const Window& own, Executor& threads);
    /// Adds the buildings of a scene, and whether its mask and NDVI cover it. @param own core cells of the
    /// unit
    void add_buildings(const Scene& scene, const Detection& detection, const Window& own, Executor& threads);
    void merge(const SceneStatistics& other);

    GroundFit fit;      ///< surface against ground, before the ground was clamped to the surface
    GroundSlope slope;  ///< slope of the ground, sampled in some rows
    AuxiliaryCoverage sides{false, false, false};
    ParcelFit parcels;
    SurfaceSampling sampling;
    ValidIslands islands;
};

}  // namespace d2b::detect
