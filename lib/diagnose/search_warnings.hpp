#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "contours/level_plan.hpp"
#include "core/context.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "detect/scene_statistics.hpp"
#include "options/run_plan.hpp"

namespace d2b::diagnose {

/// Returns a warning if there is no ground for an estimate. A clause without a full stop; "" if there may be.
[[nodiscard]] std::string missing_ground_warning(const detect::ValidIslands& islands, GroundMode mode,
                                                 const std::string& dem);

/// Returns the reason why a terrain or a mask prevents any detection. A clause without a full stop; "" if
/// they do not.
[[nodiscard]] std::string empty_auxiliary_warning(const detect::AuxiliaryCoverage& known,
                                                  const Options& options);
/// Returns a warning if an NDVI has no values; "" if it has.
[[nodiscard]] std::string ndvi_warning(const detect::AuxiliaryCoverage& known, const Options& options);

/// Returns a warning if most of the ground is steep. A clause without a full stop; "" if it is not.
[[nodiscard]] std::string slope_warning(const detect::GroundSlope& slope, const std::string& dem);

/// Returns the reason why a ground cannot be right, and possible remedies: the surface lies more than 2 m
/// above or below it on bare cells, or fewer than 5 % of the cells are bare. A clause without a full stop; ""
/// if the ground is plausible.
/// @param fit fit of the surface to the given or estimated ground or, for GroundMode::none, to 0
/// @param terrain name of the given terrain
[[nodiscard]] std::string ground_warning(const detect::GroundFit& fit, GroundMode mode,
                                         const std::string& terrain);

/// Returns the reason why a raster may not be a surface model: hardly anything rises above its ground. "" if
/// enough does.
/// @param dem name of the raster
/// @param max_building_width in m, if the raster may hold a wider building, which is taken for the ground
[[nodiscard]] std::string surface_warning(const detect::GroundFit& fit, const std::string& dem,
                                          std::optional<double> max_building_width = {});

/// Returns the reason why parcels may be misplaced: they touch no building, or lie next to walls instead of
/// on them. A clause without a full stop; "" if they are plausible.
[[nodiscard]] std::string misplaced_warning(const ParcelReport& report, const CellSize& cell,
                                            const DetectOptions& options);
/// Same, if parcels overlap.
[[nodiscard]] std::string overlap_warning(const ParcelReport& report, const DetectOptions& options);
/// Same, if some parcels are invalid.
[[nodiscard]] std::string validity_warning(const ParcelReport& report, const DetectOptions& options);

/// Returns the reason why none of the given footprints gets heights: they have no polygons, or lie outside of
/// the raster. A clause without a full stop; "" if one has cells.
/// @param layer name of their dataset @param dem name of the raster
[[nodiscard]] std::string unplaced_footprints_warning(const FootprintReport& report, const std::string& layer,
                                                      const std::string& dem);

/// Facts about a completed search for buildings.
struct SearchSummary {
    const DemInfo& dem;
    const RunPlan& plan;
    const Tally& tally;  ///< counts of rejected objects
    const detect::SceneStatistics& scene;
    CellSize cell;
    bool has_crs = true;
    double terrain_outside = 0;  ///< share of the window outside of the given terrain model
    std::size_t buildings = 0;   ///< number that remains
};

/// Returns the most probable reason why no building was found, and possible remedies. A clause without a full
/// stop.
[[nodiscard]] std::string explain_empty_search(const SearchSummary& search);

/// Returns the reason why no building was found, if elevations and thresholds alone show it; a search for
/// buildings knows more (search_warnings.hpp). A clause without a full stop; "" if buildings were found, or
/// if the search has to explain it.
/// @param report report with the statistics
[[nodiscard]] std::string explain_empty_result(const contours::LevelPlan& plan, std::size_t buildings,
                                               const DemInfo& dem, const RunReport& report);

/// Emits the warnings about a search for buildings: an implausible ground, a raster that may not be a
/// surface, an NDVI without values, sparse points, blurred walls, and the probable reason if nothing was
/// found. Each cause is reported once. Silent if no point is valid or all have one elevation, because
/// explain_empty_result() reports that.
void warn_about_search(const SearchSummary& search, bool found_any, Context& context);

}  // namespace d2b::diagnose
