#pragma once

#include <cstdint>

#include "detect/regions.hpp"

namespace d2b {

/// How compact an object is: small houses are, groups of bushes and pieces of crowns have arms and bays.
class FormSums {
  public:
    /// Adds a run; those of an object come in scan order, so that sums are the same wherever it lies.
    void add(std::int32_t r, const RegionRun& run);

    /// The area as a share of that of the ellipse with the same second moments, which is the same however
    /// the object is stretched: 0.955 for rectangles and parallelograms, 1 for ellipses, less for what has
    /// arms. Cells are squares, not points. 1 where there is none.
    [[nodiscard]] double compactness() const;

  private:
    std::int32_t first_row_ = 0;
    std::int32_t first_col_ = 0;
    double cells_ = 0;
    // Sums over the middles of cells, from that of the first one.
    double down_ = 0;
    double across_ = 0;
    double down_down_ = 0;
    double across_across_ = 0;
    double down_across_ = 0;
};

}  // namespace d2b
