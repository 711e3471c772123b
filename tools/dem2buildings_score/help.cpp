#include "dem2buildings_score/help.hpp"

#include <nlohmann/json.hpp>

#include "dem2buildings_score/command_line.hpp"

namespace d2b {

const ToolTexts& score_texts() {
    const std::string description =
        "Measures how well building footprints agree with a reference: area and objects that were found, the "
        "distance of outlines, overlaps, invalid polygons, the number of vertices, and heights. Also how "
        "much both look like buildings: corners, main directions, short edges. With -roofs, measures how "
        "well planes of roofs agree.";
    const std::string inputs = "Both are vector datasets with polygons, in any CRS. ";
    static const ToolTexts texts{
        "dem2buildings_score",
        "[options] <found> <reference>",
        "agreement of building footprints with a reference",
        {description, inputs + options_anywhere},
        {description,
         inputs + "Lengths are in m and areas in m2, also if the data have other units. Invalid polygons are "
                  "counted and repaired.",
         std::string(options_anywhere) + names_after_dashes},
        {score_options().begin(), score_options().end()},
        {"Done; the figures may be good or bad.",
         "Failed: an input cannot be read, or the inputs lie in different places.",
         "Wrong usage: a wrong option, or one that does not fit the inputs."},
        {"dem2buildings_score buildings.gpkg cadastre.gpkg",
         "dem2buildings_score -json -dem dsm.tif -aoi quarter.gpkg found.gpkg cadastre.gpkg",
         "dem2buildings_score -roofs found.gpkg planes.gpkg"},
        "dem2buildings(1), ogrinfo(1)"};
    return texts;
}

std::string score_options_json() {
    nlohmann::ordered_json options = nlohmann::ordered_json::array();
    for (const ScoreOption& option : score_options())
        if (!option.value.empty() && !option.of_roofs)
            options.push_back({{"name", option.name}, {"kind", option.kind}, {"help", option.help}});
    return options.dump() + "\n";
}

}  // namespace d2b
