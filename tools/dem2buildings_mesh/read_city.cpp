// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/read_city.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "dem2buildings_mesh/city_json.hpp"
#include "dem2buildings_mesh/solid.hpp"

namespace d2b::mesh {
namespace {

using Json = CityJson::Json;

/// Largest step, so that products of two stay far from the limits of the arithmetic.
constexpr std::int64_t farthest = std::int64_t{1} << 40;

std::array<double, 3> three_numbers(const CityJson& file, const Json& transform, const std::string& key) {
    const Json& list = file.array(transform, key, "its transform");
    std::array<double, 3> numbers{};
    for (std::size_t i = 0; i < 3; ++i) {
        if (list.size() != 3 || !list[i].is_number())
            file.refuse("has a '" + key + "' that is not three numbers; the file is damaged");
        numbers[i] = list[i].get<double>();
        if (!std::isfinite(numbers[i]) || (key == "scale" && numbers[i] <= 0))
            file.refuse("has a '" + key + "' that is unusable; the file is damaged");
    }
    return numbers;
}

std::vector<SurfacePoint> vertices_of(const CityJson& file) {
    std::vector<SurfacePoint> points;
    for (const Json& vertex : file.array(file.root(), "vertices", "it")) {
        std::array<std::int64_t, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) {
            if (!vertex.is_array() || vertex.size() != 3 || !vertex[i].is_number_integer())
                file.refuse("has a vertex that is not three whole numbers; the file is damaged");
            // Beyond the ends of an integer JSON has numbers without sign, or with a point.
            at[i] = vertex[i].get<std::int64_t>();
            if (std::abs(at[i] / 2) > farthest / 2)
                file.refuse("has a vertex farther away than any city; the file is damaged");
        }
        points.push_back({at[0], at[1], at[2]});
    }
    return points;
}

std::optional<FaceKind> kind_of(const std::string& type) {
    if (type == "RoofSurface")
        return FaceKind::roof;
    if (type == "WallSurface")
        return FaceKind::wall;
    return type == "GroundSurface" ? std::optional(FaceKind::ground) : std::nullopt;
}

class SolidReader {
  public:
    SolidReader(const CityJson& file, const std::vector<SurfacePoint>& vertices, std::string where)
        : file_(file), vertices_(vertices), where_(std::move(where)) {}

    [[nodiscard]] std::vector<SolidFace> read(const Json& geometry) const;

  private:
    [[nodiscard]] std::vector<FaceKind> kinds(const Json& geometry, std::size_t faces) const;
    [[nodiscard]] std::vector<SurfacePoint> ring(const Json& indices) const;

    const CityJson& file_;
    const std::vector<SurfacePoint>& vertices_;
    std::string where_;
};

std::vector<FaceKind> SolidReader::kinds(const Json& geometry, std::size_t faces) const {
    const Json& semantics = file_.object(geometry, "semantics", where_);
    const Json& surfaces = file_.array(semantics, "surfaces", where_);
    const Json& values = file_.array(semantics, "values", where_);
    if (values.size() != 1 || !values[0].is_array() || values[0].size() != faces)
        file_.refuse("does not give for each face of " + where_ + " its kind; the file is damaged");
    std::vector<FaceKind> kinds;
    for (const Json& value : values[0]) {
        const auto kind =
            kind_of(file_.text(surfaces[file_.index(value, surfaces.size(), where_)], "type", where_));
        if (!kind)
            file_.refuse("has a face in " + where_ +
                         " that is neither roof nor wall nor ground; give a file that -surface wrote");
        kinds.push_back(*kind);
    }
    return kinds;
}

std::vector<SurfacePoint> SolidReader::ring(const Json& indices) const {
    if (!indices.is_array())
        file_.refuse("has a ring in " + where_ + " that is not a list; the file is damaged");
    std::vector<SurfacePoint> ring;
    for (const Json& value : indices)
        ring.push_back(vertices_[file_.index(value, vertices_.size(), where_)]);
    return ring;
}

std::vector<SolidFace> SolidReader::read(const Json& geometry) const {
    if (file_.text(geometry, "type", where_) != "Solid")
        file_.refuse("has a geometry in " + where_ + " that is not a Solid; give a file that -surface wrote");
    const Json& shells = file_.array(geometry, "boundaries", where_);
    if (shells.size() != 1 || !shells[0].is_array())
        file_.refuse("does not have exactly one shell in " + where_ + "; give a file that -surface wrote");
    const std::vector<FaceKind> kinds = this->kinds(geometry, shells[0].size());
    std::vector<SolidFace> faces;
    for (const Json& rings : shells[0]) {
        if (!rings.is_array() || rings.empty())
            file_.refuse("has a face in " + where_ + " without a ring; the file is damaged");
        SolidFace& face = faces.emplace_back(SolidFace{kinds[faces.size()], {}});
        for (const Json& indices : rings)
            face.rings.push_back(ring(indices));
    }
    return faces;
}

/// A divided building has no geometry of its own, but its parts have.
bool is_divided(const CityJson& file, const std::string& name, const Json& object) {
    return file.text(object, "type", name) == "Building" && !object.contains("geometry") &&
           object.contains("children");
}

std::string parent_of(const CityJson& file, const std::string& name, const Json& object) {
    const Json& parents = file.array(object, "parents", name);
    const Json& all = file.object(file.root(), "CityObjects", "it");
    if (parents.size() != 1 || !parents[0].is_string() || !all.contains(parents[0].get<std::string>()))
        file.refuse("has '" + name + "', a part of a missing building; the file is damaged");
    return parents[0].get<std::string>();
}

CityBuilding building_of(const CityJson& file, const std::string& name, const Json& object,
                         const std::vector<SurfacePoint>& vertices, CityModel& city) {
    const std::string type = file.text(object, "type", name);
    if (type != "Building" && type != "BuildingPart")
        file.refuse("has '" + name +
                    "', which is neither a Building nor a BuildingPart; give a file that -surface wrote");
    const Json& geometries = file.array(object, "geometry", name);
    if (geometries.size() != 1)
        file.refuse("does not have exactly one geometry in " + name + "; give a file that -surface wrote");
    city.lod = file.text(geometries[0], "lod", name);
    const std::vector<SolidFace> faces = SolidReader(file, vertices, name).read(geometries[0]);
    if (const auto fault = fault_of(faces, city.lod == "2.2"))
        file.refuse("has a solid, " + name + ", that " + *fault + "; the file is damaged");
    CityBuilding building = mesh::building_of(faces);
    building.name = name;
    if (type == "BuildingPart")
        building.whole = parent_of(file, name, object);
    if (object.contains("attributes"))
        building.attributes =
            file.object(object, "attributes", name).dump(-1, ' ', false, Json::error_handler_t::replace);
    return building;
}

}  // namespace

std::string place_text(const CityModel& city, FinePoint point) {
    return fixed_text(city.translate[0] + static_cast<double>(point.col) * city.scale[0], 3) + " " +
           fixed_text(city.translate[1] - static_cast<double>(point.row) * city.scale[1], 3);
}

CityModel parse_city(const std::string& text, const std::string& name) {
    const CityJson file(text, name);
    const Json& root = file.root();
    if (file.text(root, "type", "it") != "CityJSON" || file.text(root, "version", "it") != "2.0")
        file.refuse("is not CityJSON 2.0; give a file that -surface wrote");
    CityModel city;
    city.name = name;
    const Json& transform = file.object(root, "transform", "it");
    city.scale = three_numbers(file, transform, "scale");
    city.translate = three_numbers(file, transform, "translate");
    if (root.contains("metadata"))
        city.reference_system =
            file.text(file.object(root, "metadata", "it"), "referenceSystem", "its metadata");
    const std::vector<SurfacePoint> vertices = vertices_of(file);
    for (const auto& [key, object] : file.object(root, "CityObjects", "it").items())
        if (!is_divided(file, key, object))
            city.buildings.push_back(building_of(file, key, object, vertices, city));
    // building_2 before building_10.
    std::ranges::sort(city.buildings, [](const CityBuilding& a, const CityBuilding& b) {
        return a.name.size() != b.name.size() ? a.name.size() < b.name.size() : a.name < b.name;
    });
    return city;
}

}  // namespace d2b::mesh
