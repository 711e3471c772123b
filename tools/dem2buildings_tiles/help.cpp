#include "dem2buildings_tiles/help.hpp"

#include "common/help_text.hpp"
#include "common/roff.hpp"
#include "dem2buildings/version.hpp"
#include "dem2buildings_tiles/command_line.hpp"

namespace d2b {
namespace {

constexpr std::string_view description =
    "Finds the buildings of a country in an elevation raster, in steps that any number of processes and "
    "machines "
    "work on. The result is that of dem2buildings, byte for byte.";
constexpr std::string_view steps_text =
    "plan comes first. Then find works on all tiles, in any order and at the same time; then join; then "
    "draw, again on all tiles; then merge. If the destination is a folder (-f FlatGeobuf), write works on "
    "all tiles last. Processes share the work folder. Each step writes its file in one rename, and does "
    "nothing if that file exists: repeat the same command after an interruption.";
constexpr std::string_view place_text =
    "Relative file names refer to the folder in which plan was run, on every machine.";
constexpr std::string_view refused_text =
    "plan refuses what the steps cannot do exactly: -flow_ready, -min_gap, -min_wall, -surface, -page, "
    "-preview, -sweep, -simplify, -write_rejected and -preset thesis, and -footprints with a folder of "
    "files. -write_ground, -write_height and -write_canopy name a VRT: find writes one GeoTIFF per tile, and "
    "join the file that shows them as one raster. With -footprints, merge reads all elevations once more.";

std::string heading(const TileOption& option) {
    return "-" + std::string(option.name) + (option.value.empty() ? "" : " ") + std::string(option.value);
}

std::string help_of(const TileOption& option) {
    return std::string(option.help) + (option.steps.empty() ? "" : " (" + std::string(option.steps) + ")");
}

}  // namespace

std::string tiles_short_usage() {
    return "Usage: dem2buildings_tiles plan|find|join|draw|merge|write ...\n"
           "Try dem2buildings_tiles --help for the steps.\n";
}

std::string tiles_help() {
    std::string text = "Usage:\n";
    for (const TileStepName& step : tile_step_names())
        text += "  dem2buildings_tiles " + std::string(step.name) + " " + std::string(step.arguments) + "\n";
    text += "\n" + wrap(description, 0) + "\n" + wrap(steps_text, 0) + "\n" + wrap(place_text, 0) + "\n" +
            wrap(refused_text, 0) + "\nSteps:\n";
    for (const TileStepName& step : tile_step_names())
        text += help_entry(std::string(step.name), std::string(step.help));
    text += "\nOptions in addition to those of dem2buildings, which plan takes:\n";
    for (const TileOption& option : tile_options())
        text += help_entry(heading(option), help_of(option));
    return text + gdal_help() +
           "\nExit status: 0 done, 1 failed, 2 wrong usage, 130 after Ctrl-C, 143 terminated.\n";
}

std::string tiles_man_page() {
    // Has no date, because the same sources must give the same page.
    std::string text = ".TH DEM2BUILDINGS_TILES 1 \"\" \"dem2buildings " + std::string(version) + "\"\n" +
                       roff_section("NAME") +
                       "dem2buildings_tiles \\- building footprints of a country, in steps\n" +
                       roff_section("SYNOPSIS");
    for (const TileStepName& step : tile_step_names())
        text += ".B dem2buildings_tiles " + std::string(step.name) + "\n" + std::string(step.arguments) +
                "\n.br\n";
    text += roff_section("DESCRIPTION") + roff_paragraph(description) + roff_paragraph(steps_text) +
            roff_paragraph(place_text) + roff_paragraph(refused_text) + roff_section("STEPS");
    for (const TileStepName& step : tile_step_names())
        text += roff_item(step.name, step.help);
    text += roff_section("OPTIONS") +
            roff_paragraph("plan takes the options of dem2buildings(1), with the same meaning.");
    for (const TileOption& option : tile_options())
        text += roff_item(heading(option), help_of(option));
    text += gdal_man_section() + roff_section("EXIT STATUS") + roff_item("0", "Done, or done before.") +
            roff_item("1", "Failed: something cannot be read or written, or belongs to another plan.") +
            roff_item("2", "Wrong usage: an option, or one that does not work in tiles.") +
            roff_item("130", "Interrupted (SIGINT); 143 after SIGTERM, 129 after SIGHUP.");
    text += roff_section("EXAMPLES") +
            roff_example("dem2buildings_tiles plan country.vrt buildings.gpkg work") +
            roff_example("dem2buildings_tiles find work 0 1 2 3") +
            roff_example("dem2buildings_tiles join work") +
            roff_example("dem2buildings_tiles draw work 0 1 2 3") +
            roff_example("dem2buildings_tiles merge work");
    return text + roff_section("SEE ALSO") + "dem2buildings(1), gdalbuildvrt(1), parallel(1)\n";
}

std::string tiles_bash_completion() {
    std::string steps;
    for (const TileStepName& step : tile_step_names())
        steps += (steps.empty() ? "" : " ") + std::string(step.name);
    std::string options;
    for (const TileOption& option : tile_options())
        options += " -" + std::string(option.name);
    std::string of_plan;
    for (const OptionRow& row : option_table())
        if (!row.hidden)
            of_plan += " -" + row.name;
    return "# Completes command lines of dem2buildings_tiles in Bash.\n"
           "_dem2buildings_tiles() {\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} options=\"" +
           options.substr(1) +
           "\"\n"
           "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
           "        COMPREPLY=($(compgen -W \"" +
           steps +
           " $options\" -- \"$word\"))\n"
           "        return\n"
           "    fi\n"
           "    [ \"${COMP_WORDS[1]}\" = plan ] && options=\"$options" +
           of_plan +
           "\"\n"
           "    case $word in\n"
           "        -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
           "        *) COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
           "    esac\n"
           "}\n"
           "complete -o filenames -F _dem2buildings_tiles dem2buildings_tiles\n";
}

}  // namespace d2b
