#pragma once

#include <limits>
#include <vector>

#include "core/context.hpp"
#include "dem2buildings/options.hpp"
#include "levels/building_cells.hpp"
#include "levels/elevation_histogram.hpp"
#include "levels/level_plan.hpp"

namespace d2b {

/// Cells that lie side by side, belong to one label and have the same elevation.
struct EvenCells {
    Label label = 0;
    std::int64_t cells = 0;
    double elevation = 0;
};
/// Of the valid cells of a band that have a label other than 0. Clean elevations have few for many cells.
[[nodiscard]] std::vector<EvenCells> even_cells(const ElevationBand& elevations, const LabelBand& labels);
/// Of the valid cells of a building.
[[nodiscard]] std::vector<EvenCells> even_cells(const BuildingCells& cells, Label label);

/// What the thresholds of each building depend on: exact, so that the order of bands does not matter.
class BuildingStatistics {
  public:
    /// @param labels highest label @param fixed for sums of elevations
    /// @param metres in a vertical unit, where histograms are kept as well: some 50 bytes for each tenth of a
    /// metre in which a building has points; 0: none are
    BuildingStatistics(Label labels, const FixedPoint& fixed, double metres = 0)
        : fixed_(fixed),
          metres_(metres),
          stats_(labels + std::size_t{1}),
          histograms_(metres > 0 ? stats_.size() : 0) {}

    /// From several threads, where no two of them have cells of the same label.
    void add(const std::vector<EvenCells>& cells);
    [[nodiscard]] const PointStats& of(Label label) const { return stats_[label]; }
    /// Only where histograms are kept.
    [[nodiscard]] const ElevationHistogram& histogram(Label label) const { return histograms_[label]; }
    [[nodiscard]] const FixedPoint& fixed() const { return fixed_; }
    [[nodiscard]] Label labels() const { return static_cast<Label>(stats_.size() - 1); }

  private:
    FixedPoint fixed_;
    double metres_;
    std::vector<PointStats> stats_;
    std::vector<ElevationHistogram> histograms_;
};

/// A set of thresholds for each building: the filter of Chittineni (2003, 4.1) where it works. With mean m
/// and sample standard deviation s of the building's elevations, t_i = m - s + 2 s i / (n + 1), i = 1..n; n
/// is LOD, or less, so that thresholds are at least half a metre apart: a flat roof has no tiers. With
/// LevelSource::natural they are the natural breaks of the elevations instead, at most LOD of them, in tenths
/// of a metre and as far apart. Explicit levels and intervals hold for every building. With
/// LevelSource::global the slices are those of the whole DEM. Thresholds that no point or every point of the
/// building exceeds are left out.
/// @param statistics with histograms where LevelSource::natural is asked for
/// @param ground elevation of each label's ground, recorded as the threshold of level 1; [0] is not used
/// @param global of the whole DEM; its minimum is that of level 0
/// @param border_price of a border as long as a cell between two tiers, in squared vertical units of a point:
/// natural breaks are as many as are worth their borders; 0: as many as there are
/// @param metres in a vertical unit
[[nodiscard]] LevelPlan plan_building_levels(const BuildingStatistics& statistics,
                                             const std::vector<double>& ground, const LevelPlan& global,
                                             const LevelOptions& options, LevelSource source, double metres,
                                             double border_price = 0);

}  // namespace d2b
