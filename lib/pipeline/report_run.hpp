#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "contours/contour.hpp"
#include "contours/level_plan.hpp"
#include "core/context.hpp"
#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/run.hpp"
#include "diagnose/coverage.hpp"
#include "diagnose/ground_fit.hpp"
#include "diagnose/parcel_fit.hpp"
#include "diagnose/surface_sampling.hpp"
#include "elevations/elevation_reader.hpp"
#include "features/drawn_stack.hpp"
#include "pipeline/run_setup.hpp"

namespace d2b {

/// Measures the error of the stack against the elevations. @param stack as drawn, in the reader's window
[[nodiscard]] StackError measure_stack(const DrawnStack& stack, const FixedPoint& fixed,
                                       ElevationReader& reader);

/// Same for each of the stacks that end at level 1, 2, ... @param levels number of levels
[[nodiscard]] std::vector<StackError> measure_cuts(const DrawnStack& stack, std::int32_t levels,
                                                   const FixedPoint& fixed, ElevationReader& reader);

/// Returns the warnings of all sinks since the last call.
[[nodiscard]] std::vector<std::string> take_warnings(const Sinks& sinks);

/// Issues the warnings of sources and sinks, whichever thread raised them.
void pass_warnings(const Sources& sources, const Sinks& sinks, Context& context);

/// @param levels of the label with the most levels, including the root
void report_levels(const LevelPlan& plan, int levels, RunReport& report);

/// Counts buildings with labels up to `last`; labels above are low-confidence candidates.
[[nodiscard]] std::size_t buildings_up_to(Label last, const ContourList& contours);

/// Statistics gathered during the search for buildings.
struct SearchStatistics {
    GroundFit fit;
    GroundSlope slope;
    AuxiliaryCoverage sides;
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
                    const SearchStatistics* facts, Context& context);

/// Completes the results of all sinks. @param commit publishes them @throws OutputError, Cancelled
void prepare_sinks(const Sinks& sinks, CommitList& commit, Context& context);

}  // namespace d2b
