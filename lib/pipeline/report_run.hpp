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

/// Returns the warnings of all sinks since the last call.
[[nodiscard]] std::vector<std::string> take_warnings(const Sinks& sinks);

/// Issues the warnings of sources and sinks, whichever thread raised them.
void pass_warnings(const Sources& sources, const Sinks& sinks, Context& context);

/// @param levels of the label with the most levels, including the root
void report_levels(const LevelPlan& plan, int levels, RunReport& report);

/// Counts buildings with labels up to `last`; labels above are low-confidence candidates.
[[nodiscard]] std::size_t buildings_up_to(Label last, const ContourList& contours);

/// Statistics gathered during the search for buildings.
struct SearchFacts {
    GroundFit fit;
    GroundSlope slope;
    SidesKnown sides;
    ParcelFit parcels;
    SurfaceSampling sampling;
    ValidIslands islands;
    double terrain_outside = 0;  ///< share of the window outside of the given terrain model
};
/// @param terrain may be null
[[nodiscard]] double share_outside(const DemSource* terrain);

/// Warns if nothing was found, and of conditions that make the result unreliable. @param facts null if there
/// was no search
void warn_of_result(const RunSetup& setup, const LevelPlan& plan, std::size_t buildings,
                    const SearchFacts* facts, Context& context);

/// Completes the results of all sinks. @param commit publishes them @throws OutputError, Cancelled
void prepare_sinks(const Sinks& sinks, CommitList& commit, Context& context);

}  // namespace d2b
