#include "features/building_tiers.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace d2b {
namespace {

/// Rows of the lattice run to the south, so that a ring keeps its way round.
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

/// What has no height would be seen as a flat piece of its ground.
std::int64_t block_roof(const BuildingRecord& record, SurfaceRoof roof, const SurfaceLattice& lattice,
                        std::int64_t base) {
    return std::max(base, lattice.height(flat_roof(record, roof, lattice)));
}

}  // namespace

std::vector<SurfacePart> building_tiers(const DrawnCluster& drawn, SurfaceRoof roof,
                                        const SurfaceLattice& lattice) {
    std::vector<SurfacePart> parts(drawn.buildings.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        SurfaceBuilding& building = parts[i].buildings.emplace_back();
        building.id = drawn.buildings[i].id;
        building.base = drawn.cluster.buildings[i].base;
        building.roof = block_roof(drawn.buildings[i], roof, lattice, building.base);
    }
    std::vector<std::int32_t> places;  // of contours among the tiers of their buildings
    for (std::size_t i = 0; i < drawn.cluster.contours.size(); ++i) {
        const PlanContour& contour = drawn.cluster.contours[i];
        std::vector<SurfaceTier>& tiers =
            parts[static_cast<std::size_t>(contour.building)].buildings.front().tiers;
        places.push_back(static_cast<std::int32_t>(tiers.size()));
        tiers.push_back(tier_of(contour, drawn.levels[i],
                                contour.parent < 0 ? -1 : places[static_cast<std::size_t>(contour.parent)]));
    }
    return parts;
}

}  // namespace d2b
