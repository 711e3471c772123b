#pragma once

#include <string>
#include <string_view>

namespace d2b {

// The parts of a man page; texts are escaped here.

/// Text as roff: backslashes and dashes escaped, no line that begins with a control character.
[[nodiscard]] std::string roff(std::string_view text);
[[nodiscard]] std::string roff_section(std::string_view name);
[[nodiscard]] std::string roff_paragraph(std::string_view text);
/// A tagged paragraph. @param more further sentences, or ""
[[nodiscard]] std::string roff_item(std::string_view tag, std::string_view text, std::string_view more = "");
[[nodiscard]] std::string roff_example(std::string_view command);

}  // namespace d2b
