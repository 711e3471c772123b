#pragma once

#include <string_view>

#include "core/crs/proj_objects.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {

/// @throws OptionError with PROJ's reason if the text is not a CRS
[[nodiscard]] PjPtr parse_crs(const ProjContext& context, std::string_view text);

/// Returns the error for a text that PROJ has just rejected.
[[nodiscard]] OptionError unreadable(std::string_view text, const ProjContext& context);

}  // namespace d2b
