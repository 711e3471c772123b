#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include "core/context.hpp"
#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/run.hpp"
#include "detect/scene_statistics.hpp"
#include "detect/units.hpp"
#include "elevations/elevation_reader.hpp"
#include "features/record_builder.hpp"
#include "options/run_plan.hpp"
#include "pipeline/given_footprints.hpp"

namespace d2b::pipeline {

/// Elevations of a part of the window in metres; NaN if there is none.
/// Borrows the reader's grid if that holds all elevations in this form, because this saves a copy and a pass
/// over it. The destructor restores and returns it.
class UnitSurface {
  public:
    /// @param metres per vertical unit @throws InputError, Cancelled
    UnitSurface(ElevationReader& reader, const Window& seen, double metres, Executor& threads);
    UnitSurface(const UnitSurface&) = delete;
    UnitSurface& operator=(const UnitSurface&) = delete;
    ~UnitSurface();

    [[nodiscard]] const MetreGrid& elevations() const { return elevations_; }
    /// Mutable access for callers that undo their changes.
    [[nodiscard]] MetreGrid& elevations() { return elevations_; }
    /// Sets flagged cells to NaN until destruction. @param flags per cell
    void mask_flagged(const Grid<std::uint8_t>& flags, std::uint8_t flag, Executor& threads);

  private:
    struct MaskedCell {
        std::size_t cell;
        float elevation;
    };

    ElevationReader& reader_;
    MetreGrid elevations_;
    bool is_borrowed_ = false;
    std::vector<MaskedCell> masked_cells_;
};

/// Values shared by all units of a window, so that no result depends on the division into units.
struct UnitFrame {
    Window window;
    CellSize cell;      ///< at the centre of the window
    double metres = 1;  ///< metres per vertical unit
};

/// Inputs and outputs of the search for ground and buildings.
struct UnitSearch {
    const RunPlan& plan;
    const Sources& sources;
    const Sinks& sinks;
    ElevationReader& reader;
    UnitFrame frame;
    Context& context;
    GivenFootprints* given = nullptr;  ///< receives the statistics of the units for each; null without
};

/// Detection result of one unit.
struct FoundInUnit {
    Grid<Label> labels;                                            ///< labels of the unit's extent
    std::vector<detect::SeenObject> objects;                       ///< by label - 1
    detect::SceneStatistics scene;                                 ///< of the unit's own cells
    std::vector<std::vector<detect::SeenFootprint>> footprints{};  ///< by layer of given footprints
    std::vector<std::size_t> effective{};                          ///< corrections that have had an effect
};

/// Estimates or reads the terrain, detects buildings above it, and writes the requested rasters. The result
/// is a pure function of the cells in the unit's extent and of the plan and frame of the search.
/// @throws InputError, OutputError, Cancelled
[[nodiscard]] FoundInUnit find_in_unit(const UnitSearch& search, const detect::Unit& unit);

/// Result of ground estimation and building detection over a DEM.
struct FoundBuildings {
    /// Appends the building with the next label.
    void add(const features::Footprint& footprint) {
        footprints.push_back(footprint);
        ground.push_back(footprint.ground);
    }

    detect::LabelRows
        labels;           ///< labels of the window; low-confidence candidates only if they are to be written
    Label buildings = 0;  ///< labels above are low-confidence candidates
    std::vector<features::Footprint> footprints{{}};  ///< by label; [0] is not used
    /// Ground elevations in the vertical unit, by label.
    std::vector<double> ground{std::numeric_limits<double>::quiet_NaN()};
    detect::SceneStatistics scene;
    std::set<std::size_t> effective;  ///< corrections that have had an effect

    [[nodiscard]] Label count() const { return static_cast<Label>(footprints.size() - 1); }
    /// Returns the labels of a band of the window. Thread-safe.
    [[nodiscard]] LabelBand band(const BandShape& shape) const { return labels.band(shape); }
};

/// Halo of a unit in building widths, chosen because both units at a seam must see a building there whole,
/// together with the ground around it.
inline constexpr double halo_widths = 5;
/// Divides a window into units.
[[nodiscard]] detect::UnitGrid unit_grid(const RunPlan& plan, const Window& window, const CellSize& cell,
                                         const detect::UnitSize& size = {});

/// Returns the minimum number of own cells of an object. Smaller ones are slivers on the far side of a seam.
[[nodiscard]] std::int64_t min_cells(const RunPlan& plan, const detect::UnitGrid& units,
                                     const CellSize& cell);

/// Finishes merging once all units have been added. Low-confidence candidates are counted, and removed unless
/// they are to be written.
[[nodiscard]] detect::UnitMerger::Merged merge_found_units(detect::UnitMerger& merger, const RunPlan& plan,
                                                           const detect::UnitGrid& units,
                                                           const CellSize& cell, RunReport& report);

/// Detects buildings in a window and merges objects that cross seams. Units are processed one after the other
/// because that bounds memory. @throws InputError, OutputError, Cancelled
[[nodiscard]] FoundBuildings find_buildings(const UnitSearch& search, const detect::UnitSize& size = {});

}  // namespace d2b::pipeline
