#pragma once

#include <vector>

#include "attributes/records.hpp"
#include "detect/label_rows.hpp"
#include "detect/unit_grid.hpp"
#include "pipeline/find_in_unit.hpp"

namespace d2b {

/// What ground and detection know of a DEM.
struct FoundBuildings {
    FoundBuildings();
    /// What has the next label. @param elevation of its ground, in the vertical unit
    void add(double elevation, const DetectedObject& object);

    LabelRows labels;                   ///< of the window; what is doubtful only where it is to be written
    Label buildings = 0;                ///< labels above are doubtful
    std::vector<Footprint> footprints;  ///< by label; [0] is not used
    std::vector<double> ground;         ///< elevations in the vertical unit, by label
    GroundFit fit{0};                   ///< of the surface to the ground, before that was kept below it
    GroundSlope slope;                  ///< of the ground, in some of its rows
    SidesKnown sides;
    ParcelFit parcels;
    SurfaceSampling sampling;
    ValidIslands islands;

    [[nodiscard]] Label count() const { return static_cast<Label>(footprints.size() - 1); }
    /// The labels of a band of the window. From any thread.
    [[nodiscard]] LabelBand band(const BandShape& shape) const { return labels.band(shape); }
};

/// Building widths around a unit that it sees: what stands at a seam is seen whole by both units, and so is
/// the ground around it.
inline constexpr double widths_around = 5;
/// The units of a window.
[[nodiscard]] UnitGrid unit_grid(const RunPlan& plan, const Window& window, const CellSize& cell,
                                 const UnitSize& size = {});

/// What has fewer cells of units' own is no object of theirs: slivers on the far side of a seam.
[[nodiscard]] std::int64_t least_cells(const RunPlan& plan, const UnitGrid& units, const CellSize& cell);

/// What stands in a window, when all its units have been added: what is doubtful is counted, and left out
/// where it is not to be written.
[[nodiscard]] UnitMerger::Merged join_units(UnitMerger& merger, const RunPlan& plan, const UnitGrid& units,
                                            const CellSize& cell, RunReport& report);

/// Finds what stands in a window, one unit after the other, so that memory is bounded, and joins what seams
/// between units cut.
/// @throws InputError, OutputError, Cancelled
[[nodiscard]] FoundBuildings find_buildings(const UnitSearch& search, const UnitSize& size = {});

}  // namespace d2b
