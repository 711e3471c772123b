#include "dem2buildings/help.hpp"
#include "options/gdal_contour_options.hpp"

namespace d2b {
namespace {

/// Text for a cell of a table, where a bar would end the cell.
std::string cell(std::string_view text) {
    std::string escaped;
    for (const char letter : text)
        escaped += letter == '|' ? std::string("\\|") : std::string(1, letter);
    return escaped;
}

/// Text outside of code, where angle brackets would be taken for HTML.
std::string prose(std::string_view text) {
    std::string escaped;
    for (const char letter : text) {
        if (letter == '<' || letter == '>' || letter == '*' || letter == '_')
            escaped += '\\';
        escaped += letter;
    }
    return escaped;
}

/// A line each: broken elsewhere, a line could begin with what makes a list or a heading of it.
std::string option_item(const OptionRow& row) {
    std::string text = row.help;
    for (const std::string& more : {row.details, option_facts(row)})
        text += (more.empty() ? "" : " ") + more;
    return "- `" + option_heading(row) + "`: " + prose(text) + "\n";
}

}  // namespace

std::string options_markdown() {
    std::string text =
        "# Options of dem2buildings\n\n    dem2buildings [options] <src_raster> <dst_vector>\n\n"
        "Options may stand anywhere and begin with one dash or two; values follow after a blank or an equals "
        "sign. The source stands before the destination. After `--` only file names follow.\n\n";
    for (std::size_t group = 0; group < option_group_names.size(); ++group) {
        text += "## " + std::string(option_group_names[group]) + "\n\n";
        for (const OptionRow& row : option_table())
            if (!row.hidden && row.group == static_cast<OptionGroup>(group))
                text += option_item(row);
        text += "\n";
    }
    text += "## GDAL\n\nThe switches that all programs of GDAL share.\n\n";
    text += "| Switch | Meaning |\n| --- | --- |\n";
    for (const auto& [synopsis, help] : gdal_switches())
        text += "| `" + cell(synopsis) + "` | " + cell(prose(help)) + " |\n";
    text +=
        "\n## Options of gdal_contour\n\nHow dem2buildings treats the options of gdal_contour (GDAL 3.6 to "
        "3.11).\n\n";
    text += "| gdal_contour | Here | |\n| --- | --- | --- |\n";
    for (const GdalContourOption& option : gdal_contour_options())
        text += "| `" + cell(option.synopsis) + "` | " +
                std::string(option_support_names[static_cast<std::size_t>(option.fate)]) + " | " +
                cell(prose(option.note)) + " |\n";
    return text;
}

}  // namespace d2b
