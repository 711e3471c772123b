#include "mesh/made_city.hpp"

#include <cstddef>

namespace d2b::test {

using nlohmann::json;

MadeBlock made_box(const std::string& name, std::int64_t left, std::int64_t low, std::int64_t right,
                   std::int64_t high, std::int64_t top, std::int64_t base) {
    return {name, {{left, low}, {right, low}, {right, high}, {left, high}}, base, top};
}

std::vector<MadeBlock> two_boxes() {
    return {made_box("building_1", 0, 0, 160, 80, 9000), made_box("building_2", 160, 40, 240, 120, 4000)};
}

json made_city(const std::vector<MadeBlock>& blocks) {
    json city{{"type", "CityJSON"},
              {"version", "2.0"},
              {"metadata", {{"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/25832"}}},
              {"transform", {{"scale", {0.0625, 0.0625, 0.001}}, {"translate", {500000.0, 5800000.0, 0.0}}}},
              {"CityObjects", json::object()},
              {"vertices", json::array()}};
    for (const MadeBlock& block : blocks) {
        const std::size_t first = city["vertices"].size();
        const std::size_t count = block.ring.size();
        json roof = json::array();
        json ground = json::array();
        json faces = json::array();
        json kinds{0, 2};
        for (std::size_t i = 0; i < count; ++i) {
            city["vertices"].push_back({block.ring[i].first, block.ring[i].second, block.base});
            city["vertices"].push_back({block.ring[i].first, block.ring[i].second, block.top});
            roof.push_back(first + 2 * i + 1);
            ground.insert(ground.begin(), first + 2 * i);
        }
        faces.push_back({roof});
        faces.push_back({ground});
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t a = first + 2 * i;
            const std::size_t b = first + 2 * ((i + 1) % count);
            faces.push_back({{a, b, b + 1, a + 1}});
            kinds.push_back(1);
        }
        json semantics{{"surfaces",
                        {{{"type", "RoofSurface"}}, {{"type", "WallSurface"}}, {{"type", "GroundSurface"}}}}};
        semantics["values"] = json::array({kinds});
        json solid{{"type", "Solid"}, {"lod", "1.2"}, {"semantics", semantics}};
        solid["boundaries"] = json::array({faces});
        city["CityObjects"][block.name] = {
            {"type", "Building"}, {"attributes", {{"id", 1}}}, {"geometry", json::array({solid})}};
    }
    return city;
}

}  // namespace d2b::test
