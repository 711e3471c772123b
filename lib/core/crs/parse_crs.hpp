#pragma once

#include <string_view>

#include "core/crs/proj_objects.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {

/// @throws OptionError with PROJ's reason where the text is no CRS
[[nodiscard]] PjPtr parse_crs(const ProjContext& context, std::string_view text);

/// For a text of which PROJ has just complained.
[[nodiscard]] OptionError unreadable(std::string_view text, const ProjContext& context);

}  // namespace d2b
