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

/// What holds for the whole window and is the same for all its units: none of it is worked out from a unit.
struct UnitFrame {
    Window window;
    CellSize cell;      ///< at the window's middle
    double metres = 1;  ///< in one vertical unit
};

/// How ground and buildings are looked for.
struct UnitSearch {
    const RunPlan& plan;
    const Sources& sources;
    const Sinks& sinks;
    ElevationReader& reader;
    UnitFrame frame;
    Context& context;
};

/// What stands in a unit.
struct FoundInUnit {
    Grid<Label> labels;               ///< of what it sees
    std::vector<SeenObject> objects;  ///< by label - 1
    GroundFit fit;                    ///< the rest is of its own cells
    GroundSlope slope;
    SidesKnown sides;
    ParcelFit parcels;
    SurfaceSampling sampling;
    ValidIslands islands;
};

/// Estimates or reads the terrain, detects buildings above it, and writes the rasters that are asked for. The
/// result is a function of the cells that the unit sees, and of the search's plan and frame.
/// @throws InputError, OutputError, Cancelled
[[nodiscard]] FoundInUnit find_in_unit(const UnitSearch& search, const Unit& unit);

}  // namespace d2b
