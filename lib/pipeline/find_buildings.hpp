#pragma once

#include <vector>

#include "attributes/records.hpp"
#include "core/grid.hpp"
#include "dem2buildings/run.hpp"
#include "detect/label_rows.hpp"
#include "detect/strips.hpp"
#include "diagnose/ground_fit.hpp"
#include "diagnose/ground_slope.hpp"
#include "diagnose/side_doubt.hpp"
#include "elevations/elevation_reader.hpp"
#include "options/run_plan.hpp"

namespace d2b {

/// What ground and detection know of a DEM.
struct FoundBuildings {
    LabelRows labels;                   ///< of the window; what is doubtful only where it is to be written
    Label buildings = 0;                ///< labels above are doubtful
    std::vector<Footprint> footprints;  ///< by label; [0] is not used
    std::vector<double> ground;         ///< elevations in the vertical unit, by label
    GroundFit fit{0};                   ///< of the surface to the ground, before that was kept below it
    GroundSlope slope;                  ///< of the ground, in some of its rows
    SidesKnown sides;

    [[nodiscard]] Label count() const { return static_cast<Label>(footprints.size() - 1); }
    /// The labels of a band of the window. From any thread.
    [[nodiscard]] LabelBand band(const BandShape& shape, std::int32_t window_row) const {
        return labels.band(shape, window_row);
    }
};

/// Estimates or reads the terrain, detects buildings above it, and writes the rasters that are asked for. A
/// large window is looked at in strips of rows, so that memory is bounded.
/// @param metres in one vertical unit
[[nodiscard]] FoundBuildings find_buildings(const RunPlan& plan, const Sources& sources, const Sinks& sinks,
                                            ElevationReader& reader, const CellSize& cell, double metres,
                                            Context& context, const StripSize& size = {});

}  // namespace d2b
