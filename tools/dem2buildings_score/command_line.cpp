#include "dem2buildings_score/command_line.hpp"

#include <string_view>

#include "dem2buildings/error.hpp"
#include "options/option_values.hpp"

namespace d2b {
namespace {

constexpr std::string_view program = "dem2buildings_score";
constexpr std::string_view usage = "usage: dem2buildings_score [options] <found> <reference>";

void take_file_names(const std::vector<std::string>& names, ScoreCommand& request) {
    if (names.empty())
        throw OptionError("The found and the reference footprints are missing; " + std::string(usage) + ".");
    if (names.size() == 1)
        throw OptionError("The reference is missing, there is only '" + names[0] + "'; " +
                          std::string(usage) + ".");
    if (names.size() > 2)
        throw OptionError("There are too many file names, from '" + names[2] +
                          "' on; give the found footprints and one reference.");
    if (names[0].empty() || names[1].empty())
        throw OptionError("A file name is empty; " + std::string(usage) + ".");
    request.found = names[0];
    request.reference = names[1];
}

void check_roofs(const ScoreCommand& request) {
    if (request.roofs && !request.height_field.empty())
        throw OptionError(
            "-height_field has no effect with -roofs, because planes have elevations; leave one "
            "of them out.");
    if (!request.roofs && !request.roof_types.empty())
        throw OptionError("-roof_types has no effect without -roofs; give -roofs, too, or leave it out.");
}

}  // namespace

const std::vector<ScoreOption>& score_options() {
    using Text = const std::string&;
    static const std::vector<ScoreOption> options{
        {{"layer", "<name>", "text",
          "Layer of the found footprints. Default: buildings if it exists, else the first."},
         [](ScoreCommand& r, Text value) { r.layer = value; }},
        {{"reference_layer", "<name>", "text",
          "Layer of the reference. Default: blocks_dissolved, else buildings, else the first."},
         [](ScoreCommand& r, Text value) { r.reference_layer = value; }},
        {{"height_field", "<name>", "text",
          "Field of the reference with heights above ground in m. Default: height, else Height, else "
          "roof_h."},
         [](ScoreCommand& r, Text value) { r.height_field = value; }},
        {{"aoi", "<dataset or layer>", "dataset",
          "Polygons in which the reference is complete: a layer of the reference, or the first layer of a "
          "dataset. Default: the layer aoi of the reference if it exists, else no limit."},
         [](ScoreCommand& r, Text value) { r.area_of_interest = value; }},
        {{"dem", "<raster>", "raster",
          "The raster that the footprints were found in. Areas outside it or without data are left out, and "
          "everything is measured in its CRS. Its cells say which edges are short. Default: no limit, and "
          "the "
          "CRS of the reference."},
         [](ScoreCommand& r, Text value) { r.dem = value; }},
        {{"min_object", "<m2>", "number", "Smallest object that counts. At least 0. Unit: m2. Default: 50."},
         [](ScoreCommand& r, Text value) {
             NumberRange range;
             range.lowest = 0;
             r.min_object_m2 = parse_number("min_object", range, value);
         }},
        {{"roofs", "", "switch",
          "Compare the layers roofs, which have a polygon for each plane of a roof: slopes, directions, "
          "elevations and types of roofs. -layer and -reference_layer then name other layers of planes."},
         [](ScoreCommand& r, Text) { r.roofs = true; }},
        {{"roof_types", "<dataset>", "dataset",
          "Reference buildings with the types of their roofs, in field roof_type or roof of the layer "
          "buildings. Only with -roofs. Default: the reference."},
         [](ScoreCommand& r, Text value) { r.roof_types = value; },
         true},
        {{"json", "", "switch", "Print the result as JSON."}, [](ScoreCommand& r, Text) { r.json = true; }},
        {{"q", "", "switch", "Print only the figures, without file names and the numbers behind them."},
         [](ScoreCommand& r, Text) { r.quiet = true; }},
        {{"help", "", "switch", "Print this help."}, [](ScoreCommand& r, Text) { r.help = true; }},
        {{"version", "", "switch", "Print the versions of the program and of its libraries."},
         [](ScoreCommand& r, Text) { r.version = true; }},
        {{"man", "", "switch", "Print the man page as roff."},
         [](ScoreCommand& r, Text) { r.man_page = true; }},
    };
    return options;
}

ScoreCommand parse_score_command_line(const std::vector<std::string>& arguments) {
    const std::vector<ToolOption> table(score_options().begin(), score_options().end());
    const ToolLine line = take_apart(arguments, table, program);
    ScoreCommand request;
    for (const auto& [option, value] : line.given)
        score_options()[option].apply(request, value);
    if (request.asks_for_text())
        return request;
    if (line.unknown)
        refuse_unknown_option(*line.unknown, table, program);
    take_file_names(line.names, request);
    check_roofs(request);
    return request;
}

}  // namespace d2b
