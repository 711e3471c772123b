// A damaged city is read and divided, or refused with a sentence; nothing else happens.
#include <string>

#include "dem2buildings/error.hpp"
#include "dem2buildings_mesh/city_plan.hpp"
#include "dem2buildings_mesh/read_city.hpp"
#include "fuzz/bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace d2b::test;
    try {
        const d2b::mesh::CityModel city =
            d2b::mesh::parse_city(std::string(reinterpret_cast<const char*>(data), size), "fuzzed");
        for (const d2b::mesh::CityBuilding& building : city.buildings)
            demand(!building.roofs.empty(), "a solid has a roof");
        const d2b::mesh::CityPlan plan = d2b::mesh::make_city_plan(city, {});
        for (const d2b::surface::PartitionEdge& edge : plan.plan.edges)
            demand(edge.left != edge.right && edge.from != edge.to, "an edge has two sides and two ends");
        for (const d2b::mesh::Region& region : plan.regions)
            demand(region.top > region.base, "a roof lies above its ground");
    } catch (const d2b::InputError& error) {
        const std::string what = error.what();
        demand(!what.empty() && what.find('\n') == std::string::npos, "an error is a sentence");
    }
    return 0;
}
