#pragma once

#include <string_view>

#include "dem2buildings/options.hpp"

namespace d2b {

/// Returns another program's name for a field of the buildings layer, or our own name if it has none.
[[nodiscard]] std::string_view field_name(FieldNames names, std::string_view own);

}  // namespace d2b
