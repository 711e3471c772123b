#include "make_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <cpl_vsi.h>
#include <gdal_priv.h>

#include "changed_scene.hpp"
#include "dem2buildings/error.hpp"
#include "write_raster.hpp"
#include "write_truth.hpp"

namespace d2b::sample {

namespace {

constexpr float nodata = -9999;

/// Finds the thing with a name; null if there is none.
template <typename Named>
const Named* find(std::span<const Named> all, std::string_view name) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
    return found == all.end() ? nullptr : &*found;
}

template <typename Named>
std::string names(std::span<const Named> all) {
    std::string text;
    for (const Named& one : all)
        text += (text.empty() ? "" : ", ") + std::string(one.name);
    return text;
}

RasterSpec raster_spec(const SceneChoice& choice) {
    return {grid_over(choice), {}, "EPSG:25833", nodata, true};
}

void write_surface(const std::string& path, const RasterSpec& spec, const Seen& seen) {
    write_raster(path, spec, [&](std::int32_t first_row, std::int32_t rows, std::span<float> elevations) {
        const auto cols = static_cast<std::ptrdiff_t>(spec.grid.cols);
        const auto from = seen.elevations.begin() + first_row * cols;
        std::transform(from, from + rows * cols, elevations.begin(),
                       [](float z) { return std::isnan(z) ? nodata : z; });
    });
}

void write_truth(const std::string& path, const RasterSpec& spec, const Scene& scene) {
    TruthWriter truth(path);
    truth.add_buildings("buildings", spec, scene.buildings);
    truth.add_dissolved("blocks_dissolved", spec, scene.buildings);
    if (!scene.parcels.empty())
        truth.add_parcels("parcels", spec, scene.parcels);
    truth.add_roofs("roofs", spec, scene.buildings);
    truth.finish();
}

}  // namespace

SceneChoice choose_scene(const std::string& name) {
    const std::size_t join = name.find('_');
    const Place* const place = find(places(), name.substr(0, join));
    const Survey* const survey = join == std::string::npos ? nullptr : find(surveys(), name.substr(join + 1));
    if (place == nullptr || survey == nullptr)
        throw OptionError("There is no scene " + name + "; a scene is <place>_<survey>, with a place of " +
                          names(places()) + " and a survey of " + names(surveys()) + ".");
    return {*place, *survey};
}

Survey choose_survey(const std::string& name) {
    if (const Survey* const survey = find(surveys(), name))
        return *survey;
    throw OptionError("There is no survey " + name + "; the surveys are " + names(surveys()) + ".");
}

std::vector<SceneChoice> measured_scenes() {
    constexpr std::array all{"village_lidar8", "village_thin",         "village_thinned", "village_metres",
                             "village_whole",  "village_interpolated", "hamlet_lidar2",   "hamlet_thinned",
                             "pines_lidar20",  "pines_thin",           "hillside_lidar8", "hillside_thinned",
                             "rows_lidar8",    "outskirts_lidar2",     "park_lidar2",     "town_lidar2",
                             "town_thinned",   "town_satellite",       "forest_lidar2",   "forest_lidar8",
                             "forest_thin",    "fields_lidar2",        "fields_thinned"};
    std::vector<SceneChoice> chosen;
    for (const char* const name : all)
        chosen.push_back(choose_scene(name));
    return chosen;
}

Grid grid_over(const SceneChoice& choice) {
    const double cell = choice.survey.cell;
    const auto cells = static_cast<std::int32_t>(choice.place.side / cell);
    return {cells, cells, cell, cell, {400000, cell, 0, 5800000, 0, -cell}};
}

void make_scene(const std::string& folder, const SceneChoice& choice, std::uint64_t seed) {
    const std::string own = folder + "/" + choice.name();
    VSIMkdir(own.c_str(), 0755);
    const RasterSpec spec = raster_spec(choice);
    Scene scene = choice.place.make(seed);
    scene.number_buildings();
    write_surface(own + "/dsm.tif", spec, see(scene, spec.grid, choice.survey));
    Scene bare;
    bare.ground = scene.ground;
    write_raster(own + "/dtm.tif", spec, bare);
    write_truth(own + "/reference_buildings.gpkg", spec, scene);
}

void make_changed_scene(const std::string& folder, const SceneChoice& choice, const LaterSurvey& later,
                        std::uint64_t seed) {
    const std::string own = folder + "/" + choice.name();
    VSIMkdir(own.c_str(), 0755);
    const ChangedScene scene = change_scene(choice.place.make(seed), seed);
    const RasterSpec spec = raster_spec(choice);
    write_surface(own + "/old.tif", spec, see(scene.before, spec.grid, choice.survey));
    RasterSpec moved = raster_spec({choice.place, later.survey});
    const Grid seen = moved.grid;
    moved.grid.transform[0] += later.east;
    moved.grid.transform[3] += later.north;
    write_surface(own + "/new.tif", moved, see(scene.after, seen, later.survey));
    TruthWriter truth(own + "/changes.gpkg");
    truth.add_changes("changes", spec, scene.truth);
    truth.finish();
}

}  // namespace d2b::sample
