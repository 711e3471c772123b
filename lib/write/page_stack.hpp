#pragma once

#include <cstdint>
#include <vector>

#include "dem2buildings/surfaces.hpp"
#include "write/packed_numbers.hpp"

namespace d2b {

/// The stacks of a page as numbers, and how many there are of what. Of each building: its number, the height
/// of its base and that of its roof above it, and how many tiers it has; of each tier: its level, how many
/// tiers before it the one is that it stands on (0: the ground), its height above that, and how many rings it
/// has; of each ring: how many corners, and where they lie to the east and north of the corner before them.
/// The number and the base are told from those of the building before.
class PageStack {
  public:
    void add(const SurfaceBuilding& building);

    /// Of a level and all below it.
    struct Count {
        std::int64_t contours = 0;
        std::int64_t corners = 0;
    };
    /// From level 1 up.
    [[nodiscard]] std::vector<Count> counts() const;
    [[nodiscard]] const PackedNumbers& packed() const { return numbers_; }
    [[nodiscard]] std::int64_t buildings() const { return buildings_; }

  private:
    void add_ring(const std::vector<SurfacePoint>& ring);

    PackedNumbers numbers_;
    std::int64_t buildings_ = 0;
    std::int64_t id_ = 0;
    std::int64_t base_ = 0;
    SurfacePoint corner_;
    std::vector<Count> of_level_;
};

}  // namespace d2b
