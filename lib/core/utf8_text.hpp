#pragma once

#include <string>
#include <string_view>

namespace d2b {

/// The text as UTF-8, for all that a result says in words: names of files may be any bytes, while tables, XML
/// and JSON hold characters alone. Each longest run of bytes that begins a character and does not end it, and
/// each other byte that begins none, becomes U+FFFD, as Unicode advises and reports in JSON have it.
[[nodiscard]] std::string utf8_text(std::string_view bytes);

}  // namespace d2b
