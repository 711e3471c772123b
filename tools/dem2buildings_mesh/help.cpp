// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/help.hpp"

#include "common/completion_script.hpp"
#include "common/help_text.hpp"
#include "common/roff.hpp"
#include "dem2buildings/version.hpp"
#include "dem2buildings_mesh/command_line.hpp"

namespace d2b::mesh {
namespace {

constexpr std::string_view description =
    "Makes one closed surface of good triangles of the buildings that dem2buildings -surface wrote, on "
    "level bases or on terrain, for flow solvers.";
constexpr std::string_view files =
    "The input is CityJSON as -surface writes it, the output STL, OBJ or CityJSON by the end of its name.";

}  // namespace

std::string mesh_short_usage() {
    return "Usage: dem2buildings_mesh [options] <in.city.json> <out.stl|.obj|.city.json>\n"
           "Try dem2buildings_mesh --help for the options.\n";
}

std::string mesh_help() {
    std::string text = "Usage: dem2buildings_mesh [options] <in.city.json> <out.stl|.obj|.city.json>\n\n" +
                       wrap(description, 0) + "\n" +
                       wrap(std::string(files) +
                                " Options may stand anywhere and begin with one dash or two; values follow "
                                "after a blank or an equals sign.",
                            0) +
                       "\nOptions:\n";
    for (const MeshOption& option : mesh_options())
        text += help_entry(option_heading(option), option.help);
    text += "\nGDAL:\n";
    for (const auto& [synopsis, help] : gdal_switches())
        text += help_entry(std::string(synopsis), std::string(help));
    return text + "\nExit status: 0 done, 1 failed, 2 wrong usage.\n";
}

std::string mesh_man_page() {
    // Has no date, because the same sources must give the same page.
    std::string text = ".TH DEM2BUILDINGS_MESH 1 \"\" \"dem2buildings " + std::string(version) + "\"\n" +
                       roff_section("NAME") +
                       "dem2buildings_mesh \\- closed surfaces of buildings and terrain for flow solvers\n" +
                       roff_section("SYNOPSIS") +
                       ".B dem2buildings_mesh\n[options] <in.city.json> <out.stl|.obj|.city.json>\n" +
                       roff_section("DESCRIPTION") + roff_paragraph(description) + roff_paragraph(files) +
                       roff_paragraph(
                           "Options may stand anywhere and begin with one dash or two; values follow after a "
                           "blank or an equals sign. After -- only file names follow.") +
                       roff_section("OPTIONS");
    for (const MeshOption& option : mesh_options())
        text += roff_item(option_heading(option), option.help);
    text += ".SS GDAL\n";
    for (const auto& [synopsis, help] : gdal_switches())
        text += roff_item(synopsis, help);
    text += roff_section("EXIT STATUS") + roff_item("0", "Done.") +
            roff_item("1", "Failed: an input cannot be read or used, or the output not be written.") +
            roff_item("2", "Wrong usage: an option, or one that does not fit the inputs.");
    text += roff_section("EXAMPLES") + roff_example("dem2buildings_mesh city.city.json city.stl") +
            roff_example("dem2buildings_mesh -ground ground.tif -margin 50 city.city.json city.obj");
    return text + roff_section("LICENSE") +
           roff_paragraph(
               "GNU General Public License, version 3 or later; the other programs of "
               "dem2buildings have the MIT license.") +
           roff_section("SEE ALSO") + "dem2buildings(1)\n";
}

std::string mesh_bash_completion() {
    std::string cases;
    std::string names;
    for (const MeshOption& option : mesh_options()) {
        names += (names.empty() ? "-" : " -") + option.name;
        if (!option.value.empty())
            cases += "        -" + option.name + "|--" + option.name + ") " +
                     (option.kind == "terrain" ? "COMPREPLY=($(compgen -f -- \"$word\"))" : "COMPREPLY=()") +
                     "; return ;;\n";
    }
    return completion_script("dem2buildings_mesh", cases, names);
}

}  // namespace d2b::mesh
