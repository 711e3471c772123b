#pragma once

#include <string>
#include <string_view>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// For messages, without line breaks and not too long: WKT can have pages.
[[nodiscard]] std::string quoted(std::string_view text);

/// For messages: "(9, 48.5)", whatever the locale.
[[nodiscard]] std::string position_text(const Position& p);

/// In lower case, for comparing names.
[[nodiscard]] std::string letters_and_digits(std::string_view text);

}  // namespace d2b
