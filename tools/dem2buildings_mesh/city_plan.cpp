// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/city_plan.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "dem2buildings/error.hpp"
#include "surface/partition.hpp"
#include "surface/resolve_nonmanifold.hpp"
#include "surface/roof_heights.hpp"

namespace d2b::mesh {
namespace {

std::vector<surface::PartitionContour> contours_of(const CityModel& city) {
    std::vector<surface::PartitionContour> contours;
    for (std::size_t i = 0; i < city.buildings.size(); ++i)
        for (const CityRoof& roof : city.buildings[i].roofs)
            contours.push_back({roof.outline, -1, static_cast<std::int32_t>(i), roof.z, roof.plane});
    return contours;
}

/// Touching buildings stand on one level.
void level_bases(const CityModel& city, CityPlan& result) {
    DisjointSets blocks(static_cast<std::uint32_t>(city.buildings.size()));
    const auto building = [&](std::int32_t region) {
        return static_cast<std::uint32_t>(result.regions[static_cast<std::size_t>(region)].building);
    };
    for (const surface::PartitionEdge& edge : result.plan.edges)
        if (edge.left != surface::open_ground && edge.right != surface::open_ground)
            static_cast<void>(blocks.join(building(edge.left), building(edge.right)));
    std::vector<std::int64_t> lowest(city.buildings.size(), std::numeric_limits<std::int64_t>::max());
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
        std::int64_t& base = lowest[blocks.find(i)];
        base = std::min(base, city.buildings[i].base);
    }
    for (Region& region : result.regions)
        region.base = lowest[blocks.find(static_cast<std::uint32_t>(region.building))];
}

void take_apart(const CityModel& city, const std::vector<surface::PartitionContour>& contours,
                const surface::GapTolerances& gaps, CityPlan& result) {
    const surface::ResolvedVertices taken =
        surface::resolve_nonmanifold_vertices(result.plan, contours, {0, gaps});
    for (const surface::VertexRepair& mend : taken.repairs)
        result.pinches.push_back(mend.place);
    if (taken.unresolved.empty())
        return;
    const surface::PartitionContour& contour = contours[taken.unresolved.front()];
    throw InputError("'" + city.name + "' has " +
                     city.buildings[static_cast<std::size_t>(contour.building)].name + ", near " +
                     place_text(city, contour.outline.exterior.front()) +
                     ", which touches others in an edge and cannot be separated from them; make the file "
                     "again with -surface.");
}

void require_height(const CityModel& city, const Region& region) {
    if (region.top <= region.base)
        throw InputError("'" + city.name + "' has a roof of " +
                         city.buildings[static_cast<std::size_t>(region.building)].name +
                         " that is not above the ground of its block; the file is damaged.");
}

}  // namespace

CityPlan make_city_plan(const CityModel& city, const surface::GapTolerances& gaps) {
    const std::vector<surface::PartitionContour> contours = contours_of(city);
    surface::PartitionResult partition = surface::make_partition(contours);
    if (!partition.conflicting.empty()) {
        const surface::PartitionContour& other = contours[*std::ranges::min_element(partition.conflicting)];
        throw InputError("'" + city.name + "' has two roofs over one place, or roofs that cross, near " +
                         place_text(city, other.outline.exterior.front()) + " (" +
                         city.buildings[static_cast<std::size_t>(other.building)].name +
                         "); the file is damaged.");
    }
    CityPlan result{std::move(partition.plan), {}, {}};
    take_apart(city, contours, gaps, result);
    static_cast<void>(surface::split_crossings(result.plan, contours));
    for (const surface::PartitionContour& contour : contours)
        result.regions.push_back({contour.building, contour.top, 0, contour.plane});
    level_bases(city, result);
    for (const Region& region : result.regions)
        require_height(city, region);
    return result;
}

}  // namespace d2b::mesh
