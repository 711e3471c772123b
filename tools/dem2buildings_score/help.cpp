#include "dem2buildings_score/help.hpp"

#include <nlohmann/json.hpp>

#include "common/help_text.hpp"
#include "common/roff.hpp"
#include "dem2buildings/version.hpp"
#include "dem2buildings_score/command_line.hpp"

namespace d2b {
namespace {

constexpr std::string_view description =
    "Measures how well building footprints agree with a reference: area and objects that were found, the "
    "distance of outlines, overlaps, invalid polygons, the number of vertices, and heights. Also how much "
    "both look like buildings: corners, main directions, short edges. With -roofs, measures how well planes "
    "of "
    "roofs agree.";

}  // namespace

std::string score_short_usage() {
    return "Usage: dem2buildings_score [options] <found> <reference>\n"
           "Try dem2buildings_score --help for the options.\n";
}

std::string score_help() {
    std::string text =
        "Usage: dem2buildings_score [options] <found> <reference>\n\n" + wrap(description, 0) + "\n" +
        wrap(
            "Both are vector datasets with polygons, in any CRS. Options may stand anywhere and "
            "begin with one dash or two; values follow after a blank or an equals sign.",
            0) +
        "\nOptions:\n";
    for (const ScoreOption& option : score_options())
        text += help_entry(option_heading(option), option.help);
    text += "\nGDAL:\n";
    for (const auto& [synopsis, help] : gdal_switches())
        text += help_entry(std::string(synopsis), std::string(help));
    return text + "\nExit status: 0 done, 1 failed, 2 wrong usage.\n";
}

std::string score_man_page() {
    // Has no date, because the same sources must give the same page.
    std::string text =
        ".TH DEM2BUILDINGS_SCORE 1 \"\" \"dem2buildings " + std::string(version) + "\"\n" +
        roff_section("NAME") + "dem2buildings_score \\- agreement of building footprints with a reference\n" +
        roff_section("SYNOPSIS") + ".B dem2buildings_score\n[options] <found> <reference>\n" +
        roff_section("DESCRIPTION") + roff_paragraph(description) +
        roff_paragraph(
            "Both are vector datasets with polygons, in any CRS. Lengths are in m and areas in m2, also "
            "if the data have other units. Invalid polygons are counted and repaired.") +
        roff_paragraph(
            "Options may stand anywhere and begin with one dash or two; values follow after a blank or an "
            "equals sign. After -- only file names follow.") +
        roff_section("OPTIONS");
    for (const ScoreOption& option : score_options())
        text += roff_item(option_heading(option), option.help);
    text += ".SS GDAL\n";
    for (const auto& [synopsis, help] : gdal_switches())
        text += roff_item(synopsis, help);
    text += roff_section("EXIT STATUS") + roff_item("0", "Done; the figures may be good or bad.") +
            roff_item("1", "Failed: an input cannot be read, or the inputs lie in different places.") +
            roff_item("2", "Wrong usage: a wrong option, or one that does not fit the inputs.");
    text +=
        roff_section("EXAMPLES") + roff_example("dem2buildings_score buildings.gpkg cadastre.gpkg") +
        roff_example("dem2buildings_score -json -dem dsm.tif -aoi quarter.gpkg found.gpkg cadastre.gpkg") +
        roff_example("dem2buildings_score -roofs found.gpkg planes.gpkg");
    return text + roff_section("SEE ALSO") + "dem2buildings(1), ogrinfo(1)\n";
}

std::string score_options_json() {
    nlohmann::ordered_json options = nlohmann::ordered_json::array();
    for (const ScoreOption& option : score_options())
        if (!option.value.empty() && !option.of_roofs)
            options.push_back({{"name", option.name}, {"kind", option.kind}, {"help", option.help}});
    return options.dump() + "\n";
}

}  // namespace d2b
