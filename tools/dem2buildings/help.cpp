#include "dem2buildings/help.hpp"

#include <cctype>
#include <string_view>

namespace d2b {

std::string option_heading(const OptionRow& row) {
    std::string text = "-" + row.name;
    for (const std::string& alias : row.aliases)
        text += ", -" + alias;
    return text + (row.values.empty() ? "" : " ") + row.values;
}

std::string option_facts(const OptionRow& row, bool brief) {
    std::string text;
    const auto add = [&text](const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence; };
    const bool in_synopsis = !row.choices.empty() || row.repeatable || row.values == row.range ||
                             row.arity == Arity::several || row.range == "a number";
    if (!row.range.empty() && !in_synopsis) {
        std::string range = row.range;
        for (const std::string_view noun : {"a number of ", "a number "})
            if (range.starts_with(noun))
                range.erase(0, noun.size());
        range[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(range[0])));
        add(range + ".");
    }
    if (!row.unit.empty() && row.values != "<" + row.unit + ">")
        add("Unit: " + row.unit + ".");
    if (!row.standard.empty())
        add("Default: " + row.standard + ".");
    if (row.repeatable)
        add("May be repeated.");
    if (!brief)
        for (const Preset preset : every_preset)
            if (!row.has_meaning(preset))
                add("Not with -preset " + std::string(preset_name(preset)) +
                    (row.scope.elsewhere.empty() ? "." : ", except " + row.scope.elsewhere + "."));
    return text;
}

std::string short_usage() {
    return "Usage: dem2buildings [options] <src_raster>... <dst_vector>\n"
           "Try dem2buildings --help for the options.\n";
}

namespace {

/// Lists options by group. @param all false for the everyday options alone
std::string option_list(bool all) {
    std::string text;
    for (std::size_t group = 0; group < option_group_names.size(); ++group) {
        std::string entries;
        for (const OptionRow& row : option_table()) {
            if (row.hidden || row.group != static_cast<OptionGroup>(group) || !(all || row.everyday))
                continue;
            const std::string facts = option_facts(row, true);
            entries += help_entry(option_heading(row), row.help + (facts.empty() ? "" : " ") + facts);
        }
        if (!entries.empty())
            text += "\n" + std::string(option_group_names[group]) + ":\n" + entries;
    }
    return text;
}

std::string introduction() {
    return "Usage: dem2buildings [options] <src_raster>... <dst_vector>\n\n" +
           wrap(
               "Finds the buildings of a city in an elevation raster (a surface model, DSM). Writes one "
               "polygon per building, and the contours of its parts from low to high. Several rasters on one "
               "grid, or a folder of them, are joined.",
               0);
}

}  // namespace

std::string everyday_help() {
    return introduction() + option_list(false) +
           "\nExamples:\n"
           "  dem2buildings city.tif buildings.gpkg\n"
           "  dem2buildings -ground terrain.tif -preview map.png city.tif buildings.gpkg\n\n" +
           wrap("--help_all lists all options, and \"man dem2buildings\" has them in full.", 0);
}

std::string full_help() {
    return introduction() + "\n" + wrap(options_anywhere, 0) + option_list(true) + gdal_help() +
           "\nExit status: 0 done, 1 failed, 2 wrong usage, 130 after Ctrl-C, 143 terminated.\n";
}

}  // namespace d2b
