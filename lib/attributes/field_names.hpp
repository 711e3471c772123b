#pragma once

#include <string_view>

#include "dem2buildings/options.hpp"

namespace d2b {

/// What another program calls a field of the layer of buildings; its own name where that program has no name
/// for it.
[[nodiscard]] std::string_view field_name(FieldNames names, std::string_view own);

}  // namespace d2b
