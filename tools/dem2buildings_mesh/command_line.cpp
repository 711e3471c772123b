// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/command_line.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "dem2buildings/error.hpp"
#include "options/option_values.hpp"

namespace d2b::mesh {
namespace {

constexpr std::string_view program = "dem2buildings_mesh";
constexpr std::string_view usage = "usage: dem2buildings_mesh [options] <in.city.json> <out>";

/// Those that say something of the terrain.
constexpr std::array ground_options{"inodata", "ground_error", "margin", "base", "min_wall"};

using Apply = std::function<void(MeshCommand&, const std::string&)>;

template <class Member>
Apply number(const char* name, NumberRange range, Member member) {
    return [=](MeshCommand& command, const std::string& value) {
        command.*member = parse_number(name, range, value);
    };
}

std::array<double, 3> three_numbers(const std::string& value) {
    std::array<double, 3> numbers{};
    std::size_t begin = 0;
    for (double& number : numbers) {
        const std::size_t end = std::min(value.find(' ', begin), value.size());
        number = parse_number("origin", {}, std::string_view(value).substr(begin, end - begin));
        begin = std::min(end + 1, value.size());
    }
    return numbers;
}

std::vector<MeshOption> make_options() {
    using Text = const std::string&;
    constexpr NumberRange from_zero{.lowest = 0};
    constexpr NumberRange above_zero{.lowest = 0, .above_lowest = true};
    return {
        {{"min_angle", "<degrees>", "number",
          "Smallest angle of triangles of roofs, bases and terrain, seen from above. Up to 20.7 wherever the "
          "angles of the input allow it; above that as far as ten times the points of 20.7 suffice. A number "
          "from 0 to 30. Default: 20.7."},
         number("min_angle", {.lowest = 0, .highest = 30}, &MeshCommand::min_angle)},
        {{"max_edge", "<m>", "number",
          "Longest edge, on walls as well. A number above 0. Unit: m. Default: no limit."},
         number("max_edge", above_zero, &MeshCommand::max_edge)},
        {{"ground", "<raster>", "terrain",
          "Elevations of the terrain, as -write_ground writes them: walls stand on it, and the surface gets "
          "sides and a plate below. Default: each block stands on its lowest ground."},
         [](MeshCommand& r, Text value) { r.ground = value; }},
        {{"inodata", "", "switch",
          "Keep values of the terrain that look like undeclared NoData: values that many cells along "
          "the edge share, far from all others."},
         [](MeshCommand& r, Text) { r.keeps_undeclared = true; }},
        {{"ground_error", "<m>", "number",
          "How far the terrain may be from the cells outside of the footprints. A number above 0. Unit: m. "
          "Default: 0.25."},
         number("ground_error", above_zero, &MeshCommand::ground_error)},
        {{"margin", "<m>", "number",
          "Flat land that is added around the raster and the footprints. At least 0. Unit: m. Default: 0."},
         number("margin", from_zero, &MeshCommand::margin)},
        {{"base", "<m>", "number",
          "How far the plate lies below the lowest terrain. A number above 0. Unit: m. Default: 10."},
         number("base", above_zero, &MeshCommand::base)},
        {{"min_wall", "<m>", "number",
          "Lower roofs are lifted to this height above the terrain next to them. A number above 0. Unit: m. "
          "Default: 0.5."},
         number("min_wall", above_zero, &MeshCommand::min_wall)},
        {{"origin", "<x> <y> <z>", "numbers",
          "Origin of the local coordinates in whole metres, as -surface_origin. For .stl and .obj. Default: "
          "the middle of the surface, below its lowest point."},
         [](MeshCommand& r, Text value) { r.origin = three_numbers(value); }},
        {{"overwrite", "", "switch", "Replace an existing file."},
         [](MeshCommand& r, Text) { r.overwrite = true; }},
        {{"json", "", "switch", "Print the report as JSON, with all places that it counts."},
         [](MeshCommand& r, Text) { r.json = true; }},
        {{"q", "", "switch", "Print no report."}, [](MeshCommand& r, Text) { r.quiet = true; }},
        {{"help", "", "switch", "Print this help."}, [](MeshCommand& r, Text) { r.help = true; }},
        {{"version", "", "switch", "Print the versions of the program and of its libraries."},
         [](MeshCommand& r, Text) { r.version = true; }},
        {{"man", "", "switch", "Print the man page as roff."},
         [](MeshCommand& r, Text) { r.man_page = true; }},
        {{"bash_completion", "", "switch", "Print a script that completes command lines in Bash."},
         [](MeshCommand& r, Text) { r.bash_completion = true; }},
    };
}

void take_file_names(const std::vector<std::string>& names, MeshCommand& command) {
    if (names.size() < 2)
        throw OptionError((names.empty() ? "The city file and the output are missing; "
                                         : "The output is missing, there is only '" + names[0] + "'; ") +
                          std::string(usage) + ".");
    if (names.size() > 2)
        throw OptionError("There are too many file names, from '" + names[2] +
                          "' on; give a city file and one output.");
    if (names[0].empty() || names[1].empty())
        throw OptionError("A file name is empty; " + std::string(usage) + ".");
    command.city = names[0];
    command.destination = names[1];
}

void check(const ToolLine& line, const MeshCommand& command) {
    if (command.ground.empty())
        for (const auto& [option, value] : line.given)
            if (std::ranges::find(ground_options, mesh_options()[option].name) != ground_options.end())
                throw OptionError("-" + mesh_options()[option].name +
                                  " has no effect without terrain; give -ground as well.");
    if (command.origin && std::ranges::any_of(*command.origin, [](double metres) {
            return metres != static_cast<double>(static_cast<long long>(metres));
        }))
        throw OptionError("-origin takes whole metres; leave the decimals out.");
    if (command.json && command.quiet)
        throw OptionError("-q prints no report and -json prints one; give one of them.");
}

}  // namespace

const std::vector<MeshOption>& mesh_options() {
    static const std::vector<MeshOption> options = make_options();
    return options;
}

MeshCommand parse_mesh_command_line(const std::vector<std::string>& arguments) {
    const std::vector<ToolOption> table(mesh_options().begin(), mesh_options().end());
    const ToolLine line = take_apart(arguments, table, program);
    MeshCommand command;
    for (const auto& [option, value] : line.given)
        mesh_options()[option].apply(command, value);
    if (command.asks_for_text() || command.bash_completion)
        return command;
    if (line.unknown)
        refuse_unknown_option(*line.unknown, table, program);
    take_file_names(line.names, command);
    check(line, command);
    return command;
}

}  // namespace d2b::mesh
