#pragma once

#include <string_view>

#include "core/crs.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"

namespace d2b {

/// A unit of length by one of its usual names ("m", "metre", "ft", "foot", "us-ft", "US survey foot", ...),
/// or by the metres in it as a number; letters of either case.
/// @return nothing where the text is none of these
[[nodiscard]] std::optional<LengthUnit> parse_length_unit(std::string_view text);

/// The unit that a band of elevations states. @param raster "'dem.tif'" @param option that helps
/// @return nothing where none is stated @throws InputError one that is no known unit of length
[[nodiscard]] std::optional<LengthUnit> stated_unit(const std::string& band_unit, const std::string& raster,
                                                    const std::string& option);

/// Finds horizontal and vertical units separately. Vertical: the option, then the band's unit, then the
/// vertical part of the CRS, then the horizontal unit, then metres; the report says which won.
/// @param vertical_option as given with -zunit, "" for none @throws OptionError where it is no unit
[[nodiscard]] UnitReport resolve_units(const DemInfo& info, const Crs& crs, std::string_view vertical_option);

}  // namespace d2b
