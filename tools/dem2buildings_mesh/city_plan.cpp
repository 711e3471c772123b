// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/city_plan.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "dem2buildings/error.hpp"
#include "surface/partition.hpp"
#include "surface/take_apart_pinches.hpp"

namespace d2b::mesh {
namespace {

std::vector<PlanContour> contours_of(const CityModel& city) {
    std::vector<PlanContour> contours;
    for (std::size_t i = 0; i < city.buildings.size(); ++i)
        for (const CityRoof& roof : city.buildings[i].roofs)
            contours.push_back({roof.outline, -1, static_cast<std::int32_t>(i), roof.z});
    return contours;
}

/// Touching buildings stand on one level.
void level_bases(const CityModel& city, CityPlan& result) {
    DisjointSets blocks(static_cast<std::uint32_t>(city.buildings.size()));
    const auto building = [&](std::int32_t region) {
        return static_cast<std::uint32_t>(result.regions[static_cast<std::size_t>(region)].building);
    };
    for (const PlanEdge& edge : result.plan.edges)
        if (edge.left != open_ground && edge.right != open_ground)
            static_cast<void>(blocks.join(building(edge.left), building(edge.right)));
    std::vector<std::int64_t> lowest(city.buildings.size(), std::numeric_limits<std::int64_t>::max());
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
        std::int64_t& base = lowest[blocks.find(i)];
        base = std::min(base, city.buildings[i].base);
    }
    for (Region& region : result.regions)
        region.base = lowest[blocks.find(static_cast<std::uint32_t>(region.building))];
}

void take_apart(const CityModel& city, const std::vector<PlanContour>& contours, const PlanGaps& gaps,
                CityPlan& result) {
    const PinchesTaken taken = take_apart_pinches(result.plan, contours, {0, gaps});
    for (const PinchMend& mend : taken.mends)
        result.pinches.push_back(mend.place);
    if (taken.stuck.empty())
        return;
    const PlanContour& contour = contours[taken.stuck.front()];
    throw InputError(
        "'" + city.name + "' has " + city.buildings[static_cast<std::size_t>(contour.building)].name +
        ", near " + place_text(city, contour.outline.exterior.front()) +
        ", which touches others in an edge where there is no room to part them; make the file again "
        "with -surface.");
}

void require_height(const CityModel& city, const Region& region) {
    if (region.top <= region.base)
        throw InputError("'" + city.name + "' has a roof of " +
                         city.buildings[static_cast<std::size_t>(region.building)].name +
                         " that is not above the ground of its block; the file is damaged.");
}

}  // namespace

CityPlan make_city_plan(const CityModel& city, const PlanGaps& gaps) {
    const std::vector<PlanContour> contours = contours_of(city);
    Partition partition = make_partition(contours);
    if (!partition.at_odds.empty()) {
        const PlanContour& other = contours[*std::ranges::min_element(partition.at_odds)];
        throw InputError("'" + city.name + "' has two roofs over one place, or roofs that cross, near " +
                         place_text(city, other.outline.exterior.front()) + " (" +
                         city.buildings[static_cast<std::size_t>(other.building)].name +
                         "); the file is damaged.");
    }
    CityPlan result{std::move(partition.plan), {}, {}};
    take_apart(city, contours, gaps, result);
    for (const PlanContour& contour : contours)
        result.regions.push_back({contour.building, contour.top, 0});
    level_bases(city, result);
    for (const Region& region : result.regions)
        require_height(city, region);
    return result;
}

}  // namespace d2b::mesh
