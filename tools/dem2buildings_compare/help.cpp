#include "dem2buildings_compare/help.hpp"

#include "common/help_text.hpp"
#include "common/roff.hpp"
#include "dem2buildings/version.hpp"
#include "dem2buildings_compare/command_line.hpp"

namespace d2b {
namespace {

constexpr std::string_view description =
    "Finds what changed between two surveys of a place: buildings that are new, gone, raised or lowered (the "
    "height that 90 % of the points do not exceed, by more than 2 m), grown or shrunk (by more than 10 % of "
    "the area and 20 m2), or the same. A shift between the surveys of up to two cells is estimated first.";

constexpr std::string_view inputs =
    "Both are results of dem2buildings, or both are DSMs, in which the buildings are found with the "
    "defaults. "
    "Without a destination only the summary is printed.";

}  // namespace

std::string compare_short_usage() {
    return "Usage: dem2buildings_compare [options] <old> <new> [<changes>]\n"
           "Try dem2buildings_compare --help for the options.\n";
}

std::string compare_help() {
    std::string text = "Usage: dem2buildings_compare [options] <old> <new> [<changes>]\n\n" +
                       wrap(description, 0) + "\n" + wrap(inputs, 0) + "\n" +
                       wrap(
                           "Options may stand anywhere and begin with one dash or two; values follow after a "
                           "blank or an equals "
                           "sign.",
                           0) +
                       "\nOptions:\n";
    for (const CompareOption& option : compare_options())
        text += help_entry(option_heading(option), option.help);
    text += "\nGDAL:\n";
    for (const auto& [synopsis, help] : gdal_switches())
        text += help_entry(std::string(synopsis), std::string(help));
    return text + "\nExit status: 0 done, 1 failed, 2 wrong usage.\n";
}

std::string compare_man_page() {
    // Has no date, because the same sources must give the same page.
    std::string text =
        ".TH DEM2BUILDINGS_COMPARE 1 \"\" \"dem2buildings " + std::string(version) + "\"\n" +
        roff_section("NAME") + "dem2buildings_compare \\- changes of buildings between two surveys\n" +
        roff_section("SYNOPSIS") + ".B dem2buildings_compare\n[options] <old> <new> [<changes>]\n" +
        roff_section("DESCRIPTION") + roff_paragraph(description) + roff_paragraph(inputs) +
        roff_paragraph(
            "Options may stand anywhere and begin with one dash or two; values follow after a blank or an "
            "equals sign. After -- only file names follow.") +
        roff_section("OPTIONS");
    for (const CompareOption& option : compare_options())
        text += roff_item(option_heading(option), option.help);
    text += ".SS GDAL\n";
    for (const auto& [synopsis, help] : gdal_switches())
        text += roff_item(synopsis, help);
    text += roff_section("EXIT STATUS") + roff_item("0", "Done; there may be changes or none.") +
            roff_item("1", "Failed: a survey cannot be read, or the destination cannot be written.") +
            roff_item("2", "Wrong usage: a wrong option, or a result and a DSM.");
    text += roff_section("EXAMPLES") +
            roff_example("dem2buildings_compare 2015.gpkg 2024.gpkg changes.gpkg") +
            roff_example("dem2buildings_compare -json dsm_2015.tif dsm_2024.tif");
    return text + roff_section("SEE ALSO") + "dem2buildings(1), dem2buildings_score(1)\n";
}

}  // namespace d2b
