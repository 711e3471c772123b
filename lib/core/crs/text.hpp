#pragma once

#include <string>
#include <string_view>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Quotes text for messages, without line breaks and truncated, because WKT can be long.
[[nodiscard]] std::string quoted(std::string_view text);

/// Formats a position for messages, independent of the locale: "(9, 48.5)".
[[nodiscard]] std::string position_text(const Position& p);

/// Keeps letters and digits, in lower case, for comparing names.
[[nodiscard]] std::string letters_and_digits(std::string_view text);

}  // namespace d2b
