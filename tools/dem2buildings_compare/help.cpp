#include "dem2buildings_compare/help.hpp"

#include "dem2buildings_compare/command_line.hpp"

namespace d2b {

const ToolTexts& compare_texts() {
    const std::string description =
        "Finds what changed between two surveys of a place: buildings that are new, gone, raised or lowered "
        "(the height that 90 % of the points do not exceed, by more than 2 m), grown or shrunk (by more than "
        "10 % of the area and 20 m2), or the same. A shift between the surveys of up to two cells is "
        "estimated first.";
    const std::string inputs =
        "Both are results of dem2buildings, or both are DSMs, in which the buildings are found with the "
        "defaults. Without a destination only the summary is printed.";
    static const ToolTexts texts{"dem2buildings_compare",
                                 "[options] <old> <new> [<changes>]",
                                 "changes of buildings between two surveys",
                                 {description, inputs, options_anywhere},
                                 {description, inputs, std::string(options_anywhere) + names_after_dashes},
                                 {compare_options().begin(), compare_options().end()},
                                 {"Done; there may be changes or none.",
                                  "Failed: a survey cannot be read, or the destination cannot be written.",
                                  "Wrong usage: a wrong option, or a result and a DSM."},
                                 {"dem2buildings_compare 2015.gpkg 2024.gpkg changes.gpkg",
                                  "dem2buildings_compare -json dsm_2015.tif dsm_2024.tif"},
                                 "dem2buildings(1), dem2buildings_score(1)"};
    return texts;
}

}  // namespace d2b
