#pragma once

#include <string_view>

#include "core/crs.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"

namespace d2b {

/// Parses a unit of length by one of its usual names ("m", "metre", "ft", "foot", "us-ft", "US survey foot",
/// ...) or by its metres as a number, ignoring case. @return nothing if the text is none of these
[[nodiscard]] std::optional<LengthUnit> parse_length_unit(std::string_view text);

/// Returns the unit that an elevation band states, if any. @param raster "'dem.tif'" @param option to
/// recommend in the error @throws InputError if it is not a known unit of length
[[nodiscard]] std::optional<LengthUnit> stated_unit(const std::string& band_unit, const std::string& raster,
                                                    const std::string& option);

/// Decides horizontal and vertical units separately. Vertical: the option, then the band's unit, then the
/// vertical part of the CRS, then the horizontal unit, then metres; the report names the source. @param
/// vertical_option value of -zunit, "" if not given @throws OptionError if it is not a unit
[[nodiscard]] UnitReport resolve_units(const DemInfo& info, const Crs& crs, std::string_view vertical_option);

}  // namespace d2b
