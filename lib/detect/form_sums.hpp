#pragma once

#include <cstdint>

#include "detect/regions.hpp"

namespace d2b {

/// Second moments of an object, from which its compactness follows: small houses are compact, groups of
/// bushes and parts of crowns have arms and bays.
class FormSums {
  public:
    /// Adds a run. Runs come in scan order and are measured from the first cell, so that the sums do not
    /// depend on the object's position.
    void add(std::int32_t r, const RegionRun& run);

    /// Area divided by the area of the ellipse with the same second moments. Invariant under affine maps:
    /// 0.955 for parallelograms, 1 for ellipses, less for shapes with arms. Cells count as squares, not as
    /// points. Returns 1 if there are no cells.
    [[nodiscard]] double compactness() const;

  private:
    std::int32_t first_row_ = 0;
    std::int32_t first_col_ = 0;
    double cells_ = 0;
    // Sums over cell centres, relative to the first one.
    double down_ = 0;
    double across_ = 0;
    double down_down_ = 0;
    double across_across_ = 0;
    double down_across_ = 0;
};

}  // namespace d2b
