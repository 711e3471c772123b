#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "place.hpp"
#include "survey.hpp"

namespace d2b::sample {

/// A place and how it is seen: "village_thinned".
struct SceneChoice {
    Place place;
    Survey survey;

    [[nodiscard]] std::string name() const {
        return std::string(place.name) + "_" + std::string(survey.name);
    }
};

/// @throws OptionError where a name is not that of a place and a survey
[[nodiscard]] SceneChoice choose_scene(const std::string& name);
/// @throws OptionError where there is no such survey
[[nodiscard]] Survey choose_survey(const std::string& name);
/// Those that accuracy is measured on: each place and each survey at least once.
[[nodiscard]] std::vector<SceneChoice> measured_scenes();

/// The cells over a place.
[[nodiscard]] Grid grid_over(const SceneChoice& choice);

/// Writes a folder `<folder>/<name>` with dsm.tif, dtm.tif (the bare earth at the middles of cells) and
/// reference_buildings.gpkg: exact footprints in `buildings`, these without shared walls in
/// `blocks_dissolved`, plots in `parcels` where there are any, and planes of roofs in `roofs`.
/// @throws OutputError
void make_scene(const std::string& folder, const SceneChoice& choice, std::uint64_t seed);

/// Second survey of a place that has changed.
struct LaterSurvey {
    Survey survey;
    double east = 0;  ///< displacement of its raster in metres
    double north = 0;
};

/// Writes a folder `<folder>/<name>` with old.tif and, of the place after changes, new.tif; the changes are
/// in layer `changes` of changes.gpkg, where the old survey has them. @throws OutputError
void make_changed_scene(const std::string& folder, const SceneChoice& choice, const LaterSurvey& later,
                        std::uint64_t seed);

}  // namespace d2b::sample
