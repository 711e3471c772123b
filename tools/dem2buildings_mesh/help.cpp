// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/help.hpp"

#include <CGAL/version.h>

#include "common/completion_script.hpp"
#include "dem2buildings_mesh/command_line.hpp"

namespace d2b::mesh {

const ToolTexts& mesh_texts() {
    const std::string description =
        "Makes one closed surface of good triangles of the buildings that dem2buildings -surface wrote, on "
        "level bases or on terrain, for flow solvers.";
    const std::string files =
        "The input is CityJSON as -surface writes it, the output STL, OBJ or CityJSON by the end of its "
        "name.";
    static const ToolTexts texts{
        "dem2buildings_mesh",
        "[options] <in.city.json> <out.stl|.obj|.city.json>",
        "closed surfaces of buildings and terrain for flow solvers",
        {description, files + " " + options_anywhere},
        {description, files, std::string(options_anywhere) + names_after_dashes},
        {mesh_options().begin(), mesh_options().end()},
        {"Done.", "Failed: an input cannot be read or used, or the output not be written.",
         "Wrong usage: an option, or one that does not fit the inputs."},
        {"dem2buildings_mesh city.city.json city.stl",
         "dem2buildings_mesh -ground ground.tif -margin 50 city.city.json city.obj"},
        "dem2buildings(1)",
        "GNU General Public License, version 3 or later; the other programs of dem2buildings have the MIT "
        "license.",
        std::string(", CGAL ") + CGAL_VERSION_STR};
    return texts;
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
