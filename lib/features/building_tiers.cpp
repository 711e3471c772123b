#include "features/building_tiers.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace d2b {
namespace {

/// Negates rows because they increase southwards. The ring keeps its orientation as seen from above.
std::vector<SurfacePoint> roof_ring(const FineRing& ring, std::int64_t top) {
    std::vector<SurfacePoint> corners;
    corners.reserve(ring.size());
    for (const FinePoint& point : ring)
        corners.push_back({point.col, -point.row, top});
    return corners;
}

SurfaceTier tier_of(const PlanContour& contour, std::int32_t level, std::int32_t parent) {
    SurfaceTier tier{level, parent, contour.top, {roof_ring(contour.outline.exterior, contour.top)}};
    for (const FineRing& interior : contour.outline.interiors)
        tier.rings.push_back(roof_ring(interior, contour.top));
    return tier;
}

}  // namespace

std::vector<SurfacePart> building_tiers(const DrawnCluster& drawn, SurfaceRoof roof,
                                        const SurfaceLattice& lattice) {
    std::vector<SurfacePart> parts(drawn.buildings.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        SurfaceBuilding& building = parts[i].buildings.emplace_back();
        building.id = drawn.buildings[i].id;
        building.base = drawn.cluster.buildings[i].base;
        building.roof = building.base;
    }
    std::vector<std::int32_t> places;  // index of each contour among its building's tiers
    for (std::size_t i = 0; i < drawn.cluster.contours.size(); ++i) {
        const PlanContour& contour = drawn.cluster.contours[i];
        const auto place = static_cast<std::size_t>(contour.building);
        SurfaceBuilding& building = parts[place].buildings.front();
        std::vector<SurfaceTier>& tiers = building.tiers;
        // A building without height is drawn as a flat patch of its ground.
        if (contour.parent < 0)
            building.roof =
                std::max(building.base, block_roof(drawn.buildings[place], roof, contour.outline, lattice));
        places.push_back(static_cast<std::int32_t>(tiers.size()));
        tiers.push_back(tier_of(contour, drawn.levels[i],
                                contour.parent < 0 ? -1 : places[static_cast<std::size_t>(contour.parent)]));
    }
    return parts;
}

}  // namespace d2b
