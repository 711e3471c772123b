#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/crs.hpp"
#include "core/number_from_chars.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/score.hpp"
#include "read/field_layer.hpp"
#include "read/gdal_setup.hpp"
#include "score/limits.hpp"
#include "score/measure.hpp"
#include "score/roofs.hpp"

namespace d2b::score {
namespace {

using reading::FieldFeature;
using reading::FieldLayer;
using reading::WantedField;

constexpr const char* roofs_layer = "roofs";
constexpr const char* buildings_layer = "buildings";

// Positions in the values of a feature.
enum RoofField : std::size_t { slope_field, azimuth_field, building_field, type_field };
enum BuildingField : std::size_t { building_type_field, building_id_field };

std::optional<double> number_of(const std::optional<std::string>& text) {
    const std::optional<double> value = parse_number<double>(text.value_or(""));
    return value && std::isfinite(*value) ? value : std::nullopt;
}

FieldLayer read_roofs(const std::string& dataset, const std::string& layer, Warnings& warnings) {
    const std::array<WantedField, 4> wanted{
        {{{"slope"}}, {{"azimuth"}}, {{"bldg_id"}, false}, {{"roof_type"}, false}}};
    FieldLayer roofs =
        reading::read_field_layer({dataset, layer.empty() ? roofs_layer : layer}, wanted, warnings);
    if (!roofs.elevations)
        throw InputError("The layer '" + roofs.name + "' of '" + dataset +
                         "' has polygons without elevations; give one with the planes of roofs.");
    if (roofs.features.empty())
        warnings.add("The layer '" + roofs.name + "' of '" + dataset + "' has no polygons.");
    return roofs;
}

/// @param layer must exist; "": `buildings`, else the first with geometries
FieldLayer read_buildings(const std::string& dataset, const std::string& layer, Warnings& warnings) {
    const std::array<WantedField, 2> wanted{{{{"roof_type", "roof"}}, {{"id"}, false}}};
    return reading::read_field_layer({dataset, layer, {buildings_layer}}, wanted, warnings);
}

/// Buildings with types that the reference has beside its faces; nothing if it has none.
std::optional<FieldLayer> read_reference_buildings(const ScoreRequest& request, const FieldLayer& roofs,
                                                   Warnings& warnings) {
    if (!request.roof_types.empty())
        return read_buildings(request.roof_types, {}, warnings);
    const bool faces_have_types = roofs.has[building_field] && roofs.has[type_field];
    const std::vector<std::string> layers = reading::layer_names(request.reference, warnings);
    if (std::ranges::find(layers, buildings_layer) != layers.end()) {
        const std::array<WantedField, 2> wanted{
            {{{"roof_type", "roof"}, !faces_have_types}, {{"id"}, false}}};
        FieldLayer buildings =
            reading::read_field_layer({request.reference, buildings_layer}, wanted, warnings);
        if (buildings.has[building_type_field])
            return buildings;
        return std::nullopt;
    }
    if (!faces_have_types)
        throw OptionError("'" + request.reference + "' has neither types of roofs in its layer '" +
                          roofs.name +
                          "' nor a layer 'buildings' with them; give a dataset with -roof_types.");
    return std::nullopt;
}

/// Brings a layer to the plane. @return one valid area per feature, and the angles in degrees by which the
/// north of its CRS is turned clockwise there
struct Placed {
    std::vector<Polygons> areas;
    std::vector<Polygons> original;  ///< in the plane, as given: their vertices have the elevations
    std::vector<double> turns;
};

Placed place(const FieldLayer& layer, const MeasurePlane& plane, Overlay& overlay, Warnings& warnings) {
    const Crs crs(layer.crs_wkt);
    const double step = crs.kind() == Crs::Kind::geographic ? 1e-4 : 10;
    std::vector<Polygons> all;
    for (const FieldFeature& feature : layer.features)
        all.push_back(feature.shape.polygons);
    // A needle of each feature goes with it, from its first vertex to the north.
    for (const FieldFeature& feature : layer.features) {
        const Position foot = feature.shape.polygons.front().exterior.front();
        all.push_back({{{foot, {foot.x, foot.y + step}}, {}}});
    }
    transform_to(plane, crs, layer.dataset, all, LongEdges::keep, warnings);
    Placed placed;
    const std::size_t count = layer.features.size();
    for (std::size_t i = 0; i < count; ++i) {
        const WorldRing& needle = all[count + i].front().exterior;
        placed.turns.push_back(std::atan2(needle[1].x - needle[0].x, needle[1].y - needle[0].y) * 180 /
                               std::numbers::pi);
        const bool valid = !layer.features[i].shape.open_ring && overlay.valid(all[i]);
        placed.areas.push_back(valid ? all[i] : overlay.make_valid(all[i]));
    }
    all.resize(count);
    placed.original = std::move(all);
    return placed;
}

/// Metres of one unit of the layer's elevations.
double vertical_metres(const FieldLayer& layer) {
    const auto unit = Crs(layer.crs_wkt).vertical_unit();
    return unit ? unit->metres : 1;
}

std::vector<RoofFace> faces_of(const FieldLayer& layer, const Placed& placed) {
    const double metres = vertical_metres(layer);
    std::vector<RoofFace> faces;
    for (std::size_t i = 0; i < layer.features.size(); ++i) {
        const FieldFeature& feature = layer.features[i];
        std::vector<double> elevations = feature.elevations;
        for (double& z : elevations)
            z *= metres;
        std::optional<double> azimuth = number_of(feature.values[azimuth_field]);
        if (azimuth)
            *azimuth += placed.turns[i];
        faces.push_back({placed.areas[i], fitted_plane(placed.original[i], elevations),
                         number_of(feature.values[slope_field]), azimuth});
    }
    return faces;
}

/// Cones are domed in the layer of a result.
std::string type_of(const std::string& text) {
    return text == "cone" || text == "dome" ? "domed" : text;
}

std::vector<TypedBuilding> found_buildings(const FieldLayer& layer, const Placed& placed) {
    std::vector<TypedBuilding> buildings;
    for (std::size_t i = 0; i < layer.features.size(); ++i)
        buildings.push_back(
            {placed.areas[i], type_of(layer.features[i].values[building_type_field].value_or("unknown"))});
    return buildings;
}

/// The union of the faces of each building whose faces have a type.
void add_buildings_of_faces(const FieldLayer& layer, const Placed& placed, Overlay& overlay,
                            std::vector<TypedBuilding>& buildings, std::set<std::string>& ids) {
    std::map<std::string, std::pair<std::string, std::vector<Polygons>>> by_id;
    for (std::size_t i = 0; i < layer.features.size(); ++i) {
        const auto& values = layer.features[i].values;
        if (!values[building_field] || !values[type_field])
            continue;
        auto& [type, areas] = by_id[*values[building_field]];
        type = *values[type_field];
        areas.push_back(placed.areas[i]);
    }
    for (const auto& [id, building] : by_id) {
        buildings.push_back({overlay.union_of(building.second), type_of(building.first)});
        ids.insert(id);
    }
}

void add_other_buildings(const FieldLayer& layer, const Placed& placed, const std::set<std::string>& ids,
                         std::vector<TypedBuilding>& buildings) {
    for (std::size_t i = 0; i < layer.features.size(); ++i) {
        const auto& values = layer.features[i].values;
        if (values[building_type_field] &&
            !(values[building_id_field] && ids.contains(*values[building_id_field])))
            buildings.push_back({placed.areas[i], type_of(*values[building_type_field])});
    }
}

Extent extent_of(const FieldLayer& layer, const std::vector<Polygons>& areas) {
    return {layer.dataset, Crs(layer.crs_wkt), box_of_all(areas)};
}

/// Returns the extent of a layer in its own CRS.
Extent extent_of(const FieldLayer& layer) {
    std::vector<Polygons> areas;
    for (const FieldFeature& feature : layer.features)
        areas.push_back(feature.shape.polygons);
    return extent_of(layer, areas);
}

RoofScoreRun score_datasets(const ScoreRequest& request, Warnings& warnings) {
    const FieldLayer found_roofs = read_roofs(request.found, request.layer, warnings);
    const FieldLayer found_houses = read_buildings(request.found, buildings_layer, warnings);
    const FieldLayer reference_roofs = read_roofs(request.reference, request.reference_layer, warnings);
    const std::optional<FieldLayer> reference_houses =
        read_reference_buildings(request, reference_roofs, warnings);
    std::vector<Limit> limits = limits_of(request, warnings);
    const MeasurePlane plane =
        common_plane(request, limits, extent_of(found_roofs), extent_of(reference_roofs), warnings);

    Overlay overlay;
    const Placed found_placed = place(found_roofs, plane, overlay, warnings);
    const Placed reference_placed = place(reference_roofs, plane, overlay, warnings);
    RoofSide found{faces_of(found_roofs, found_placed),
                   found_buildings(found_houses, place(found_houses, plane, overlay, warnings))};
    RoofSide reference{faces_of(reference_roofs, reference_placed), {}};
    std::set<std::string> ids;
    add_buildings_of_faces(reference_roofs, reference_placed, overlay, reference.buildings, ids);
    if (reference_houses)
        add_other_buildings(*reference_houses, place(*reference_houses, plane, overlay, warnings), ids,
                            reference.buildings);

    RoofScoreOptions options;
    options.region = region_of(limits, plane, extent_of(found_roofs, found_placed.areas),
                               extent_of(reference_roofs, reference_placed.areas), overlay, warnings);
    options.metres = plane.metres;
    options.min_object_m2 = request.min_object_m2;
    return {found_roofs.name, reference_roofs.name,       plane.name(),
            plane.metres,     options.region.has_value(), score_roofs(found, reference, options)};
}

}  // namespace
}  // namespace d2b::score

namespace d2b {

RoofScoreRun compare_roofs(const ScoreRequest& request, const Callbacks& callbacks) {
    reading::register_formats();
    Warnings warnings(callbacks.on_warning);
    return score::score_datasets(request, warnings);
}

}  // namespace d2b
