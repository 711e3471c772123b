#pragma once

#include <vector>

#include "attributes/records.hpp"
#include "detect/label_rows.hpp"
#include "detect/unit_grid.hpp"
#include "pipeline/find_in_unit.hpp"

namespace d2b {

/// Result of ground estimation and building detection over a DEM.
struct FoundBuildings {
    FoundBuildings();
    /// Appends the object with the next label. @param elevation of its ground, in the vertical unit
    void add(double elevation, const DetectedObject& object);

    LabelRows labels;     ///< labels of the window; low-confidence candidates only if they are to be written
    Label buildings = 0;  ///< labels above are low-confidence candidates
    std::vector<Footprint> footprints;  ///< by label; [0] is not used
    std::vector<double> ground;         ///< ground elevations in the vertical unit, by label
    GroundFit fit{0};   ///< surface against ground, before the ground was clamped to the surface
    GroundSlope slope;  ///< slope of the ground, sampled in some rows
    SidesKnown sides;
    ParcelFit parcels;
    SurfaceSampling sampling;
    ValidIslands islands;

    [[nodiscard]] Label count() const { return static_cast<Label>(footprints.size() - 1); }
    /// Returns the labels of a band of the window. Thread-safe.
    [[nodiscard]] LabelBand band(const BandShape& shape) const { return labels.band(shape); }
};

/// Halo of a unit in building widths, chosen because both units at a seam must see a building there whole,
/// together with the ground around it.
inline constexpr double widths_around = 5;
/// Divides a window into units.
[[nodiscard]] UnitGrid unit_grid(const RunPlan& plan, const Window& window, const CellSize& cell,
                                 const UnitSize& size = {});

/// Returns the minimum number of own cells of an object. Smaller ones are slivers on the far side of a seam.
[[nodiscard]] std::int64_t least_cells(const RunPlan& plan, const UnitGrid& units, const CellSize& cell);

/// Finishes merging once all units have been added. Low-confidence candidates are counted, and removed unless
/// they are to be written.
[[nodiscard]] UnitMerger::Merged join_units(UnitMerger& merger, const RunPlan& plan, const UnitGrid& units,
                                            const CellSize& cell, RunReport& report);

/// Detects buildings in a window and merges objects that cross seams. Units are processed one after the other
/// because that bounds memory.
/// @throws InputError, OutputError, Cancelled
[[nodiscard]] FoundBuildings find_buildings(const UnitSearch& search, const UnitSize& size = {});

}  // namespace d2b
