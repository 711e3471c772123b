#include "dem2buildings/help.hpp"
#include "options/gdal_contour_options.hpp"

namespace d2b {
namespace {

/// Escapes text outside of code, because Markdown would take angle brackets for HTML.
std::string prose(std::string_view text) {
    std::string escaped;
    for (const char letter : text) {
        if (letter == '<' || letter == '>' || letter == '*' || letter == '_')
            escaped += '\\';
        escaped += letter;
    }
    return escaped;
}

/// Formats an option as one line, because a line that is broken could begin with the mark of a list or
/// heading.
std::string option_item(const OptionRow& row) {
    std::string text = row.help;
    for (const std::string& more : {row.details, option_facts(row)})
        text += (more.empty() ? "" : " ") + more;
    return "- `" + option_heading(row) + "`: " + prose(text) + "\n";
}

std::string gdal_contour_section() {
    std::string same;
    std::string others;
    for (const GdalContourOption& option : gdal_contour_options()) {
        const std::string synopsis = "`" + std::string(option.synopsis) + "`";
        if (option.fate == OptionSupport::same)
            same += (same.empty() ? "`-" : ", `-") + std::string(option.name) + "`";
        else
            others += "- " + synopsis + ": " +
                      std::string(option_support_names[static_cast<std::size_t>(option.fate)]) +
                      ", because " + prose(option.note) + ".\n";
    }
    return "\n## Options of gdal_contour\n\nOf the options of gdal_contour (GDAL 3.6 to 3.11) these are the "
           "same: " +
           same + ". The others:\n\n" + others;
}

}  // namespace

std::string options_markdown() {
    std::string text =
        "# Options of dem2buildings\n\n    dem2buildings [options] <src_raster>... <dst_vector>\n\n"
        "Options may stand anywhere and begin with one dash or two; values follow after a blank or an equals "
        "sign. After `--` only file names follow.\n\n";
    for (std::size_t group = 0; group < option_group_names.size(); ++group) {
        text += "## " + std::string(option_group_names[group]) + "\n\n";
        for (const OptionRow& row : option_table())
            if (!row.hidden && row.group == static_cast<OptionGroup>(group))
                text += option_item(row);
        text += "\n";
    }
    text += "## GDAL\n\nThe switches that all programs of GDAL share.\n\n";
    for (const auto& [synopsis, help] : gdal_switches())
        text += "- `" + std::string(synopsis) + "`: " + prose(help) + "\n";
    return text + gdal_contour_section();
}

}  // namespace d2b
