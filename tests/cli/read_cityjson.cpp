#include "cli/read_cityjson.hpp"

#include <array>
#include <fstream>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "surface/surface_check.hpp"

namespace d2b::test {
namespace {

using Json = nlohmann::json;

class CityJsonReader {
  public:
    explicit CityJsonReader(const Json& vertices) {
        for (const Json& at : vertices)
            points_.push_back(
                {at.at(0).get<std::int64_t>(), at.at(1).get<std::int64_t>(), at.at(2).get<std::int64_t>()});
        EXPECT_EQ(std::set(points_.begin(), points_.end()).size(), points_.size())
            << "a vertex is there twice";
    }
    [[nodiscard]] SurfacePart solid(const Json& geometry) {
        part_ = {};
        places_.clear();
        SurfaceBuilding building;
        EXPECT_EQ(geometry.at("type"), "Solid");
        EXPECT_EQ(geometry.at("boundaries").size(), 1U) << "a solid of buildings has no room in it";
        const Json& faces = geometry.at("boundaries").at(0);
        const Json& kinds = geometry.at("semantics").at("values").at(0);
        EXPECT_EQ(kinds.size(), faces.size());
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const auto surface = kinds.at(i).get<std::size_t>();
            building.faces.push_back(face(faces.at(i), geometry.at("semantics").at("surfaces").at(surface)));
        }
        part_.buildings.push_back(std::move(building));
        return part_;
    }
    void expect_all_used() const { EXPECT_EQ(used_.size(), points_.size()) << "a vertex is not used"; }

  private:
    [[nodiscard]] SurfaceFace face(const Json& rings, const Json& surface) {
        static const std::map<std::string, FaceKind> kinds{{"RoofSurface", FaceKind::roof},
                                                           {"WallSurface", FaceKind::wall},
                                                           {"GroundSurface", FaceKind::ground}};
        SurfaceFace face;
        face.kind = kinds.at(surface.at("type").get<std::string>());
        for (const Json& ring : rings) {
            std::vector<std::uint32_t> corners;
            for (const Json& number : ring)
                corners.push_back(place(number.get<std::size_t>()));
            EXPECT_GE(corners.size(), 3U);
            if (face.exterior.empty())
                face.exterior = corners;
            else
                face.interiors.push_back(corners);
        }
        return face;
    }
    [[nodiscard]] std::uint32_t place(std::size_t number) {
        EXPECT_LT(number, points_.size());
        used_.insert(number);
        const auto [found, is_new] =
            places_.try_emplace(number, static_cast<std::uint32_t>(part_.points.size()));
        if (is_new)
            part_.points.push_back(points_.at(number));
        return found->second;
    }

    std::vector<SurfacePoint> points_;
    std::set<std::size_t> used_;
    SurfacePart part_;
    std::map<std::size_t, std::uint32_t> places_;
};

}  // namespace

const nlohmann::json& ReadCityJson::attributes(std::int64_t building) const {
    return root.at("CityObjects").at("building_" + std::to_string(building)).at("attributes");
}

SurfaceFrame ReadCityJson::frame() const {
    SurfaceFrame frame;
    frame.scale = root.at("transform").at("scale").get<std::array<double, 3>>();
    frame.translate = root.at("transform").at("translate").get<std::array<double, 3>>();
    return frame;
}

double ReadCityJson::volume() const {
    const auto scale = frame().scale;
    return static_cast<double>(surface::six_volumes(solids)) / 6 * scale[0] * scale[1] * scale[2];
}

double ReadCityJson::volume_of(const SurfacePart& solid) const {
    const auto scale = frame().scale;
    return static_cast<double>(surface::six_volumes({&solid, 1})) / 6 * scale[0] * scale[1] * scale[2];
}

double ReadCityJson::plan_area(FaceKind kind) const {
    const auto scale = frame().scale;
    return static_cast<double>(surface::twice_plan_area(solids, kind)) / 2 * scale[0] * scale[1];
}

ReadCityJson read_cityjson(const std::string& path) {
    ReadCityJson city;
    std::ifstream file(path);
    EXPECT_TRUE(file) << path;
    city.root = Json::parse(file);
    EXPECT_EQ(city.root.at("type"), "CityJSON");
    EXPECT_EQ(city.root.at("version"), "2.0");
    CityJsonReader reader(city.root.at("vertices"));
    for (const auto& [name, object] : city.root.at("CityObjects").items()) {
        if (object.contains("children")) {
            EXPECT_EQ(object.at("type"), "Building");
            EXPECT_EQ(object.size(), 2U) << name;
            city.parts[name] = object.at("children").get<std::vector<std::string>>();
            continue;
        }
        const std::string type = object.at("type");
        EXPECT_EQ(type, object.contains("parents") ? "BuildingPart" : "Building") << name;
        if (object.contains("parents"))
            city.parents[name] = object.at("parents").get<std::vector<std::string>>();
        EXPECT_EQ(object.at("geometry").size(), 1U);
        SurfacePart solid = reader.solid(object.at("geometry").at(0));
        EXPECT_EQ(surface::fault_of({&solid, 1}), "") << name;
        solid.buildings[0].id = std::stoll(name.substr(name.find('_') + 1));
        city.solids.push_back(std::move(solid));
    }
    reader.expect_all_used();
    std::size_t parts = 0;
    for (const auto& [name, children] : city.parts)
        for (const std::string& child : children) {
            EXPECT_EQ(city.parents[child], std::vector<std::string>{name}) << child;
            ++parts;
        }
    EXPECT_EQ(parts, city.parents.size());
    return city;
}

}  // namespace d2b::test
