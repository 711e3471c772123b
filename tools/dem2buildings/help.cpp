#include "dem2buildings/help.hpp"

#include <algorithm>
#include <cctype>

namespace d2b {
namespace {

constexpr std::size_t indent_of_help = 26;

/// "  -lod <n>                How many thresholds." The help begins a line of its own where the option is
/// long.
std::string entry(const std::string& option, const std::string& help) {
    const std::string head = "  " + option;
    const std::string text = wrap(help, indent_of_help);
    if (head.size() + 2 > indent_of_help)
        return head + "\n" + text;
    return head + text.substr(head.size());
}

}  // namespace

std::string wrap(std::string_view text, std::size_t indent, std::size_t width) {
    std::string lines;
    std::string line;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(word.size() + 1, text.size()));
        if (word.empty())
            continue;
        if (!line.empty() && indent + line.size() + 1 + word.size() > width) {
            lines += std::string(indent, ' ') + line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + std::string(word);
    }
    return lines + std::string(indent, ' ') + line + "\n";
}

std::string option_heading(const OptionRow& row) {
    std::string text = "-" + row.name;
    for (const std::string& alias : row.aliases)
        text += ", -" + alias;
    return text + (row.values.empty() ? "" : " ") + row.values;
}

std::string option_facts(const OptionRow& row, bool brief) {
    std::string text;
    const auto add = [&text](const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence; };
    const bool in_synopsis =
        row.values.find('|') != std::string::npos || row.repeatable || row.values == row.range;
    const bool left_out = in_synopsis || row.range == "a number" || (brief && row.arity == Arity::several);
    if (!row.range.empty() && !left_out)
        add(std::string(1, static_cast<char>(std::toupper(static_cast<unsigned char>(row.range[0])))) +
            row.range.substr(1) + ".");
    if (!row.unit.empty())
        add("Unit: " + row.unit + ".");
    if (!row.standard.empty())
        add("Default: " + row.standard + ".");
    if (row.repeatable)
        add("May be repeated.");
    return text;
}

const std::vector<GdalSwitch>& gdal_switches() {
    static const std::vector<GdalSwitch> switches{
        {"--config <KEY>=<VALUE>", "Set a configuration option of GDAL's; also --config <KEY> <VALUE>."},
        {"--debug <on|off|topic>", "Print GDAL's debug messages to stderr."},
        {"--formats", "List the formats of this GDAL."},
        {"--format <format>", "Describe one format and its options."},
        {"--optfile <file>", "Read further arguments from a file."},
        {"--help-general", "List all switches that the programs of GDAL share."},
    };
    return switches;
}

std::string short_usage() {
    return "Usage: dem2buildings [options] <src_raster> <dst_vector>\n"
           "Try dem2buildings --help for the options.\n";
}

std::string full_help() {
    std::string text =
        "Usage: dem2buildings [options] <src_raster> <dst_vector>\n\n" +
        wrap(
            "Traces the buildings of a city in an elevation raster (DSM) and writes them as polygons, "
            "with the stack of contours that they are made of.",
            0) +
        "\n" +
        wrap(
            "Options may stand anywhere and begin with one dash or two; values follow after a blank "
            "or an equals sign.",
            0);
    for (std::size_t group = 0; group < option_group_names.size(); ++group) {
        text += "\n" + std::string(option_group_names[group]) + ":\n";
        for (const OptionRow& row : option_table()) {
            if (row.hidden || row.group != static_cast<OptionGroup>(group))
                continue;
            const std::string facts = option_facts(row, true);
            text += entry(option_heading(row), row.help + (facts.empty() ? "" : " ") + facts);
        }
    }
    text += "\nGDAL:\n";
    for (const auto& [synopsis, help] : gdal_switches())
        text += entry(std::string(synopsis), std::string(help));
    return text + "\nExit status: 0 done, 1 failed, 2 wrong usage, 130 interrupted.\n";
}

}  // namespace d2b
