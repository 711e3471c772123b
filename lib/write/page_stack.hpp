#pragma once

#include <cstdint>
#include <vector>

#include "dem2buildings/surfaces.hpp"
#include "write/packed_numbers.hpp"

namespace d2b {

/// Stacks of a page as packed integers. Per building: id, height of the base, height of the roof above it,
/// number of tiers; per tier: level, distance in the list to its parent (0 is the ground), height above it,
/// number of rings; per ring: number of vertices and their offsets to the east and north from the previous
/// vertex. Ids and bases are differences to the previous building.
class PageStack {
  public:
    void add(const SurfaceBuilding& building);

    /// Sums of a level and all below it.
    struct Count {
        std::int64_t contours = 0;
        std::int64_t corners = 0;
    };
    /// Starts with level 1.
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
