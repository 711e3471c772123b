#pragma once

#include <string>
#include <string_view>

#include "core/utf8_text.hpp"

namespace d2b {

/// Text for an element or a quoted attribute of XML. XML 1.0 cannot hold control characters, which become
/// blanks, nor what is not UTF-8, which becomes U+FFFD.
[[nodiscard]] inline std::string xml_text(std::string_view text) {
    std::string escaped;
    for (const char letter : utf8_text(text)) {
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

}  // namespace d2b
