#include "write/page_stack.hpp"

#include <algorithm>
#include <cstddef>

namespace d2b {

void PageStack::add(const SurfaceBuilding& building) {
    ++buildings_;
    numbers_.put_signed(building.id - id_);
    numbers_.put_signed(building.base - base_);
    numbers_.put_signed(building.roof - building.base);
    numbers_.put(building.tiers.size());
    id_ = building.id;
    base_ = building.base;
    for (std::size_t i = 0; i < building.tiers.size(); ++i) {
        const SurfaceTier& tier = building.tiers[i];
        const bool stands_on_ground = tier.parent < 0;
        const auto parent = stands_on_ground ? i : static_cast<std::size_t>(tier.parent);
        numbers_.put(static_cast<std::uint64_t>(tier.level));
        numbers_.put(i - parent);
        numbers_.put_signed(tier.top - (stands_on_ground ? building.base : building.tiers[parent].top));
        numbers_.put(tier.rings.size());
        const auto level = static_cast<std::size_t>(tier.level);
        of_level_.resize(std::max(of_level_.size(), level));
        ++of_level_[level - 1].contours;
        for (const std::vector<SurfacePoint>& ring : tier.rings) {
            add_ring(ring);
            of_level_[level - 1].corners += static_cast<std::int64_t>(ring.size());
        }
    }
}

void PageStack::add_ring(const std::vector<SurfacePoint>& ring) {
    numbers_.put(ring.size());
    for (const SurfacePoint& point : ring) {
        numbers_.put_signed(point.x - corner_.x);
        numbers_.put_signed(point.y - corner_.y);
        corner_ = point;
    }
}

std::vector<PageStack::Count> PageStack::counts() const {
    std::vector<Count> sums = of_level_;
    for (std::size_t i = 1; i < sums.size(); ++i) {
        sums[i].contours += sums[i - 1].contours;
        sums[i].corners += sums[i - 1].corners;
    }
    return sums;
}

}  // namespace d2b
