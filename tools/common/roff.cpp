#include "common/roff.hpp"

namespace d2b {

std::string roff(std::string_view text) {
    std::string escaped;
    for (const char letter : text) {
        if (letter == '\\')
            escaped += "\\e";
        else if (letter == '-')
            escaped += "\\-";
        else
            escaped += letter;
    }
    return escaped.starts_with('.') || escaped.starts_with('\'') ? "\\&" + escaped : escaped;
}

std::string roff_section(std::string_view name) {
    return ".SH " + roff(name) + "\n";
}

std::string roff_paragraph(std::string_view text) {
    return ".PP\n" + roff(text) + "\n";
}

std::string roff_item(std::string_view tag, std::string_view text, std::string_view more) {
    return ".TP\n\\fB" + roff(tag) + "\\fR\n" + roff(text) + "\n" + (more.empty() ? "" : roff(more) + "\n");
}

std::string roff_example(std::string_view command) {
    return ".PP\n.EX\n" + roff(command) + "\n.EE\n";
}

}  // namespace d2b
