#pragma once

#include <string>
#include <string_view>

namespace d2b {

/// Converts to valid UTF-8, because file names may be any bytes while tables, XML and JSON hold only
/// characters. Each maximal truncated sequence, and each other invalid byte, becomes U+FFFD, as Unicode
/// recommends.
[[nodiscard]] std::string utf8_text(std::string_view bytes);

}  // namespace d2b
