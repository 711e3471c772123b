#pragma once

#include <cstdint>

#include "detect/regions.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// How many neighbours of an object are as near in height as those on one roof: where points are few, crowns
/// give a height from anywhere within them, and the cells beside each other differ by metres.
class GentlePairs {
  public:
    /// Adds a run's pairs with the next cell and with the cell below. @param objects cells of all objects
    void add(const Scene& scene, const Mask& objects, std::int32_t r, const RegionRun& run);

    /// Share of the pairs whose slope is less than 0.55, which is steeper than most roofs; 1 where there is
    /// none.
    [[nodiscard]] double share() const;

  private:
    std::int64_t pairs_ = 0;
    std::int64_t gentle_ = 0;
};

}  // namespace d2b
