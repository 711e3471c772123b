#pragma once

#include <cstdint>
#include <vector>

#include "contours/level_plan.hpp"
#include "contours/merge_regions.hpp"
#include "contours/natural_breaks.hpp"
#include "core/context.hpp"
#include "dem2buildings/options.hpp"

namespace d2b::contours {

/// Run of adjacent cells with the same label and elevation.
struct ConstantRun {
    Label label = 0;
    std::int64_t cells = 0;
    double elevation = 0;
};
/// Returns the runs of valid labelled cells of a band. Clean elevations have few runs for many cells.
[[nodiscard]] std::vector<ConstantRun> constant_runs(const ElevationBand& elevations,
                                                     const LabelBand& labels);
/// Returns the runs of valid cells of a building.
[[nodiscard]] std::vector<ConstantRun> constant_runs(const BuildingCells& cells, Label label);

/// Statistics that determine the thresholds of each building. Exact, so that the order of bands does not
/// matter.
class BuildingStatistics {
  public:
    /// @param labels highest label
    /// @param fixed fixed-point format for sums of elevations
    /// @param metres metres per vertical unit, if histograms are needed: some 50 bytes per tenth of a metre
    /// in which a building has points; 0: no histograms
    BuildingStatistics(Label labels, const FixedPoint& fixed, double metres = 0)
        : fixed_(fixed),
          metres_(metres),
          stats_(labels + std::size_t{1}),
          histograms_(metres > 0 ? stats_.size() : 0) {}

    /// Adds runs. Callable from several threads if no two of them have cells of the same label.
    void add(const std::vector<ConstantRun>& cells);
    [[nodiscard]] const PointStats& of(Label label) const { return stats_[label]; }
    /// Requires histograms.
    [[nodiscard]] const ElevationHistogram& histogram(Label label) const { return histograms_[label]; }
    [[nodiscard]] const FixedPoint& fixed() const { return fixed_; }
    [[nodiscard]] Label labels() const { return static_cast<Label>(stats_.size() - 1); }

  private:
    FixedPoint fixed_;
    double metres_;
    std::vector<PointStats> stats_;
    std::vector<ElevationHistogram> histograms_;
};

/// Plans thresholds for each building by the filter of Chittineni (2003, 4.1): with mean m and sample
/// standard deviation s of the building's elevations, t_i = m - s + 2 s i / (n + 1), i = 1..n. n is LOD, or
/// less, so that thresholds are at least half a metre apart, because a flat roof has no tiers.
///
/// LevelSource::natural yields the natural breaks of the elevations instead, at most LOD of them, in tenths
/// of a metre and equally far apart. Explicit levels and intervals apply to every building.
/// LevelSource::global uses the slices of the whole DEM. Thresholds exceeded by no point or by every point of
/// the building are dropped.
/// @param statistics with histograms if LevelSource::natural is requested
/// @param ground ground elevation by label, recorded as the threshold of level 1; [0] is unused
/// @param global plan of the whole DEM; its minimum is that of level 0
/// @param border_price price of a border of one cell between two tiers, in squared vertical units of a point:
/// natural breaks must be worth their borders; 0: no price
/// @param metres metres per vertical unit
[[nodiscard]] LevelPlan plan_building_levels(const BuildingStatistics& statistics,
                                             const std::vector<double>& ground, const LevelPlan& global,
                                             const LevelOptions& options, LevelSource source, double metres,
                                             double border_price = 0);

}  // namespace d2b::contours
