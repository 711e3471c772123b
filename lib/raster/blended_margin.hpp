#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/invalid_elevations.hpp"
#include "core/undeclared_nodata.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Values of cells without an elevation, as far as they are known.
struct MissingValues {
    std::optional<double> declared;  ///< value of the cells that are read as NaN
    std::vector<double> undeclared;  ///< see UndeclaredNodata
    ElevationLimits limits;          ///< a value outside of them may be one more
};

/// Finds out if the cells beside missing ones were blended with their value, because the raster was resampled
/// before that value was declared: many of them lie beyond the range of all cells farther away. Looks at
/// strips of the window.
/// @param step smallest step of a wall, in units of the values
/// @param read values before limits are applied
[[nodiscard]] BlendedMargin find_blended_margin(const Window& window, MissingValues missing, double step,
                                                const ReadValues& read);

/// Value of blended cells.
inline constexpr double blended_value = std::numeric_limits<double>::infinity();

/// Reads a part of a raster, with `blended_value` in the margin, where it is blended. @param raster rows and
/// columns that can be read
void read_without_margin(const BlendedMargin& margin, const Window& raster, const Window& part,
                         std::span<double> values, const ReadValues& read);

/// Returns the warning. @param stored `margin.with` as the raster stores it
[[nodiscard]] std::string blended_text(std::int64_t cells, const BlendedMargin& margin,
                                       const std::string& raster, const std::string& stored);

}  // namespace d2b
