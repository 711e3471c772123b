#pragma once

#include <vector>

#include "ground/aligned_grid.hpp"
#include "ground/ground.hpp"
#include "ground/outliers.hpp"

namespace d2b::ground {

/// The grid on which small objects are looked for: the lowest points of blocks or, where blocks are cells,
/// the surface itself, whose memory it has until that is given back. A grid of the window less.
class WorkingSurface {
  public:
    /// @param surface NaN where a point is not valid; not to be used until it is given back
    /// @param shape of the surface
    WorkingSurface(MetreGrid& surface, const AlignedGrid& shape, const GridPlace& place, Factor factor,
                   Executor& threads);

    /// `no_value` where a block has no point.
    [[nodiscard]] const AlignedGrid& lowest() const { return lowest_; }

    /// What lies below the limits of pits is left out.
    void take_out(const std::vector<Pit>& pits);
    /// The surface is as it was. @param pits that were taken out
    void give_back(const std::vector<Pit>& pits);

  private:
    [[nodiscard]] float lowest_above(const Pit& pit) const;

    MetreGrid& surface_;
    GridPlace place_;
    Factor factor_;
    Executor& threads_;
    AlignedGrid lowest_;
    std::vector<float> taken_out_;  ///< by pit
};

}  // namespace d2b::ground
