#pragma once

#include <string>

#include "compare/surveyed_building.hpp"
#include "core/crs.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/compare.hpp"

namespace d2b::compare {

/// Survey in its own CRS.
struct ReadSurvey {
    ComparedSurvey about;
    Crs crs;
    SurveyedPlace place;
};

/// Reads the buildings of a result: its layer `buildings`, or the first one. Its cells follow from areas and
/// numbers of cells. @throws InputError: cannot be read @throws OptionError: a field is missing
[[nodiscard]] ReadSurvey read_buildings(const std::string& dataset, Warnings& warnings);

/// Finds the buildings of a DSM with the defaults. @throws Error as run()
[[nodiscard]] ReadSurvey find_buildings(const std::string& dsm, const Callbacks& callbacks);

}  // namespace d2b::compare
