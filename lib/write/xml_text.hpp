#pragma once

#include <string>
#include <string_view>

namespace d2b {

/// Text for an element or a quoted attribute of XML. Control characters, which XML 1.0 cannot hold, become
/// blanks.
[[nodiscard]] inline std::string xml_text(std::string_view text) {
    std::string escaped;
    for (const char letter : text) {
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
