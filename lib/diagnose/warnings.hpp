#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/context.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"

namespace d2b::diagnose {

/// Formats a length for a sentence, to the metre, or to the decimetre below ten: "43", "0.3".
[[nodiscard]] std::string rounded(double value);
/// Formats a share as a percentage: "12 %", "0.3 %", or "less than 0.1 %".
[[nodiscard]] std::string percent(double share);
/// Turns a clause into a sentence: capitalises it and adds a full stop.
[[nodiscard]] std::string as_sentence(std::string cause);

/// Emits a warning for a cause unless it is "".
inline void warn_unless_empty(const std::string& cause, Context& context) {
    if (!cause.empty())
        context.warn(as_sentence(cause));
}

/// Returns the reason why a raster may be a picture and not a surface: three bands, or byte values. A clause
/// without a full stop; "" if it has neither.
[[nodiscard]] std::string picture_warning(const DemInfo& dem);

/// Returns the reason why coordinates may be undeclared degrees: there is no CRS, they lie within 180 of 0,
/// and cells have the size of typical cells in degrees. "" if they are not degrees.
[[nodiscard]] std::string degrees_warning(const DemInfo& dem, bool has_crs);

/// Returns a warning if the raster is smaller than a building; "" if it is larger.
/// @param width, height extent in m
[[nodiscard]] std::string extent_warning(const std::string& dem, double width, double height);

/// Returns a warning if points are too sparse: more than 8 % of the cells have no point. Beyond that the
/// classifier of detect/ uses its weights for sparse points alone, and half of the small houses in
/// docs/accuracy.md are missed. A clause without a full stop; "" if points are dense enough.
/// @param side cell size in m
[[nodiscard]] std::string sparse_points_warning(const SamplingReport& report, double side);

/// True if walls are blurred: they fall over more than 2.5 cells.
[[nodiscard]] bool is_blurred(const SamplingReport& report);
/// Same, if walls are blurred.
[[nodiscard]] std::string blur_warning(const SamplingReport& report, double side);

/// Same, if elevations were rounded to half a metre or more.
/// @param metres metres per vertical unit
[[nodiscard]] std::string rounding_warning(const SamplingReport& report, double metres);

/// Returns a warning if cells are too coarse for single buildings: wider than 3 m. A clause without a full
/// stop; "" if they are not.
/// @param cell_m cell size in m
[[nodiscard]] std::string coarse_cells_warning(double cell_m);

/// Returns a warning if the volumes of surfaces are not those on the ground, because the projection changes
/// areas by more than 1 % and heights stay as they are. A clause without a full stop; "" if they are.
/// @param crs its name @param area_scale area in the plane of the CRS, divided by that on the ground
[[nodiscard]] std::string surface_scale_warning(const std::string& crs, double area_scale);

/// Returns a warning if all roofs are level, or more than half of their area is doubtful. A clause without a
/// full stop; "" if less is.
[[nodiscard]] std::string doubtful_roofs_warning(const RoofReport& roofs);

/// Returns a warning if -simplify would remove most of a building: its tolerance exceeds 100 cells. A clause
/// without a full stop; "" if it does not.
/// @param tolerance, cell tolerance and cell size in units of the DEM's CRS
[[nodiscard]] std::string tolerance_warning(double tolerance, double cell);

/// Returns a warning with the share of outlines that stay as traced, or have no walls although `walls` were
/// requested, if it exceeds 5 % of the length of the buildings; without a layer of buildings, 90 % of the
/// contours, because most borders between tiers of a real roof have no wall. A clause without a full stop; ""
/// if it is less.
/// @param cell_size_m cell size in m; 0 if unknown
[[nodiscard]] std::string traced_warning(const OutlineLength& buildings, const OutlineLength& contours,
                                         bool walls, double cell_size_m);

/// Maximum number of points in the extent of a unit of a divided window, and its cause.
struct SeenPoints {
    static constexpr std::int64_t usual = std::int64_t{48} << 20;
    static constexpr std::int64_t most = std::int64_t{1} << 30;  ///< upper limit

    std::int64_t points = 0;
    double around = 0;  ///< width of the halo in m
    std::optional<double>
        max_building_width;  ///< width in m, if `around` depends on it and it can be changed
};

/// Returns a notice with the memory required, if it is more than usual. A clause without a full stop; "" if
/// it is not.
[[nodiscard]] std::string unit_memory_notice(const SeenPoints& seen);
/// Returns the reason why it is too much, and possible remedies; "" if it is not.
[[nodiscard]] std::string unit_memory_refusal(const SeenPoints& seen);

}  // namespace d2b::diagnose
