#pragma once

#include <cstdint>

#include "detect/regions.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Share of neighbouring cells of an object whose height difference is that of a roof. In sparse scans crowns
/// have heights from anywhere within them, so that adjacent cells differ by metres.
class GentlePairs {
  public:
    /// Adds the pairs of a run with the next cell and with the cell below.
    /// @param objects cells of all objects
    void add(const Scene& scene, const Mask& objects, std::int32_t r, const RegionRun& run);

    /// Share of pairs with a slope below 0.55, which is steeper than most roofs; 1 if there are no pairs.
    [[nodiscard]] double share() const;

  private:
    std::int64_t pairs_ = 0;
    std::int64_t gentle_ = 0;
};

}  // namespace d2b
