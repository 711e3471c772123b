#pragma once

#include <string>
#include <string_view>

#include "core/utf8_text.hpp"

namespace d2b {

/// For an element or a quoted attribute of XML that names a file, whose bytes it keeps: who reads it opens
/// the file by them. Control characters, which XML 1.0 cannot hold, become blanks.
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

/// The same for text: what is not UTF-8, which XML cannot hold either, becomes U+FFFD.
[[nodiscard]] inline std::string xml_text(std::string_view text) {
    return xml_file_name(utf8_text(text));
}

}  // namespace d2b
