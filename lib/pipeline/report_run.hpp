#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/context.hpp"
#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/run.hpp"
#include "diagnose/ground_fit.hpp"
#include "diagnose/ground_slope.hpp"
#include "diagnose/parcel_fit.hpp"
#include "diagnose/side_doubt.hpp"
#include "diagnose/surface_sampling.hpp"
#include "diagnose/valid_islands.hpp"
#include "levels/level_plan.hpp"
#include "pipeline/run_setup.hpp"
#include "trace/contour_list.hpp"

namespace d2b {

/// What sinks have noticed since the last call.
[[nodiscard]] std::vector<std::string> take_warnings(const Sinks& sinks);

/// Warns of what sources and sinks have noticed, on whichever thread.
void pass_warnings(const Sources& sources, const Sinks& sinks, Context& context);

/// @param levels of the label with most, the root counted
void report_levels(const LevelPlan& plan, int levels, RunReport& report);

/// Labels above the last are doubtful.
[[nodiscard]] std::size_t buildings_up_to(Label last, const ContourList& contours);

/// What a search for buildings says of itself.
struct SearchFacts {
    GroundFit fit;
    GroundSlope slope;
    SidesKnown sides;
    ParcelFit parcels;
    SurfaceSampling sampling;
    ValidIslands islands;
    double terrain_outside = 0;  ///< share of the window outside of the terrain model that is given
};
/// @param terrain may be null
[[nodiscard]] double share_outside(const DemSource* terrain);

/// Warns where nothing was found, and of what makes doubtful what was. @param facts null where nothing was
/// searched
void warn_of_result(const RunSetup& setup, const LevelPlan& plan, std::size_t buildings,
                    const SearchFacts* facts, Context& context);

/// Completes the results of all sinks. @param commit shows them @throws OutputError, Cancelled
void prepare_sinks(const Sinks& sinks, CommitList& commit, Context& context);

}  // namespace d2b
