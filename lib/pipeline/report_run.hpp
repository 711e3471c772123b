#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "contours/contour.hpp"
#include "contours/level_plan.hpp"
#include "core/context.hpp"
#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/run.hpp"
#include "detect/scene_statistics.hpp"
#include "elevations/elevation_reader.hpp"
#include "features/drawn_stack.hpp"
#include "pipeline/run_setup.hpp"

namespace d2b::pipeline {

/// Measures the error of the stack against the elevations. @param stack as drawn, in the reader's window
[[nodiscard]] features::StackError measure_stack(const features::DrawnStack& stack, const FixedPoint& fixed,
                                                 ElevationReader& reader);

/// Measures the errors of the stack as drawn, which replace those of the contours as traced in the report.
void report_stack_errors(const features::DrawnStack& stack, const FixedPoint& fixed, ElevationReader& reader,
                         RunReport& report);

/// Returns the warnings of all sources, or sinks, since the last call.
[[nodiscard]] std::vector<std::string> take_warnings(const Sources& sources);
[[nodiscard]] std::vector<std::string> take_warnings(const Sinks& sinks);

/// Issues the warnings of sources and sinks, whichever thread raised them.
void pass_warnings(const Sources& sources, const Sinks& sinks, Context& context);

/// @param levels of the label with the most levels, including the root
void report_levels(const contours::LevelPlan& plan, int levels, RunReport& report);

/// Counts buildings with labels up to `last`; labels above are low-confidence candidates.
[[nodiscard]] std::size_t buildings_up_to(Label last, const contours::ContourList& contours);

/// Warns if nothing was found, and of conditions that make the result unreliable.
/// @param scene null if there was no search @param terrain given terrain model or null
void warn_of_result(const features::RunSetup& setup, const contours::LevelPlan& plan, std::size_t buildings,
                    const detect::SceneStatistics* scene, const DemSource* terrain, Context& context);

/// Counts the corrections by kind, and warns of those that have had no effect.
/// @param source null without corrections @param effective their indices
void report_corrections(const CorrectionSource* source, const std::set<std::size_t>& effective,
                        const std::string& dataset, Context& context);

/// Completes the results of all sinks. @param commit publishes them @throws OutputError, Cancelled
void prepare_sinks(const Sinks& sinks, CommitList& commit, Context& context);

}  // namespace d2b::pipeline
