#pragma once

#include <vector>

#include "core/context.hpp"
#include "core/grid.hpp"
#include "dem2buildings/run.hpp"
#include "detect/merge_units.hpp"
#include "detect/unit_grid.hpp"
#include "diagnose/ground_fit.hpp"
#include "diagnose/ground_slope.hpp"
#include "diagnose/parcel_fit.hpp"
#include "diagnose/side_doubt.hpp"
#include "diagnose/surface_sampling.hpp"
#include "diagnose/valid_islands.hpp"
#include "elevations/elevation_reader.hpp"
#include "options/run_plan.hpp"

namespace d2b {

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
};

/// Detection result of one unit.
struct FoundInUnit {
    Grid<Label> labels;               ///< labels of the unit's extent
    std::vector<SeenObject> objects;  ///< by label - 1
    GroundFit fit;                    ///< this and the following statistics cover the unit's own cells only
    GroundSlope slope;
    SidesKnown sides;
    ParcelFit parcels;
    SurfaceSampling sampling;
    ValidIslands islands;
};

/// Estimates or reads the terrain, detects buildings above it, and writes the requested rasters. The result
/// is a pure function of the cells in the unit's extent and of the plan and frame of the search.
/// @throws InputError, OutputError, Cancelled
[[nodiscard]] FoundInUnit find_in_unit(const UnitSearch& search, const Unit& unit);

}  // namespace d2b
