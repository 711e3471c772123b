#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/text.hpp"

namespace d2b::writing {

/// Escapes a file name for an XML element or quoted attribute and keeps its bytes, because readers open the
/// file by them. Control characters, which XML 1.0 does not permit, become blanks.
[[nodiscard]] inline std::string xml_file_name(std::string_view name) {
    std::string escaped;
    for (const char letter : name) {
        if (letter == '&')
            escaped += "&amp;";
        else if (letter == '<')
            escaped += "&lt;";
        else if (letter == '>')
            escaped += "&gt;";
        else if (letter == '"')
            escaped += "&quot;";
        else
            escaped += static_cast<unsigned char>(letter) < 0x20 && letter != '\n' ? ' ' : letter;
    }
    return escaped;
}

/// Same for text: invalid UTF-8, which XML does not permit either, becomes U+FFFD.
[[nodiscard]] inline std::string xml_text(std::string_view text) {
    return xml_file_name(utf8_text(text));
}

/// Returns an element with text on a line of its own.
[[nodiscard]] inline std::string xml_element(int indent, const std::string& name, std::string_view text) {
    return std::string(static_cast<std::size_t>(indent), ' ') + "<" + name + ">" + xml_text(text) + "</" +
           name + ">\n";
}

}  // namespace d2b::writing
