#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "contours/level_plan.hpp"
#include "core/context.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "diagnose/coverage.hpp"
#include "diagnose/ground_fit.hpp"
#include "options/run_plan.hpp"

namespace d2b {

/// Facts about a completed search for buildings.
struct SearchSummary {
    const DemInfo& dem;
    const RunPlan& plan;
    const Tally& tally;  ///< counts of rejected objects
    const GroundFit& fit;
    AuxiliaryCoverage sides;
    CellSize cell;
    bool has_crs = true;
    GroundSlope slope = {};
    std::optional<ParcelReport> parcels = {};
    std::optional<SamplingReport> sampling = {};
    ValidIslands islands = {};
    double terrain_outside = 0;  ///< share of the window
};

/// Returns the reason why the ground of a search cannot be right: only buildings have elevations, or see
/// ground_warning(). A clause without a full stop; "" if the ground is plausible.
[[nodiscard]] std::string search_ground_warning(const SearchSummary& search);

/// Returns the most probable reason why no building was found, and possible remedies. A clause without a full
/// stop.
[[nodiscard]] std::string explain_empty_search(const SearchSummary& search);

/// Returns the reason why no building was found, if elevations and thresholds alone show it; a search for
/// buildings knows more (search_warnings.hpp). A clause without a full stop; "" if buildings were found, or
/// if the search has to explain it.
/// @param report report with the statistics
[[nodiscard]] std::string explain_empty_result(const LevelPlan& plan, std::size_t buildings,
                                               const DemInfo& dem, const RunReport& report);

/// Emits the warnings about a search for buildings: an implausible ground, a raster that may not be a
/// surface, an NDVI without values, sparse points, blurred walls, and the probable reason if nothing was
/// found. Each cause is reported once. Silent if no point is valid or all have one elevation, because
/// explain_empty_result() reports that.
void warn_about_search(const SearchSummary& search, bool found_any, Context& context);

}  // namespace d2b
