#pragma once

#include <vector>

#include "ground/aligned_grid.hpp"
#include "ground/ground.hpp"
#include "ground/outliers.hpp"

namespace d2b::ground {

/// Grid on which small objects are detected: the lowest points of blocks or, if blocks are cells, the surface
/// itself, whose memory is borrowed until give_back(). This saves one grid of the window.
class WorkingSurface {
  public:
    /// @param surface NaN for points that are not valid; must not be used until it is given back
    /// @param shape of the surface
    WorkingSurface(MetreGrid& surface, const AlignedGrid& shape, const GridPlace& place, Factor factor,
                   Executor& threads);

    /// `no_value` if a block has no point.
    [[nodiscard]] const AlignedGrid& lowest() const { return lowest_; }

    /// Removes points below the limits of low outliers.
    void take_out(const std::vector<Pit>& pits);
    /// Restores the surface. @param pits low outliers removed by take_out()
    void give_back(const std::vector<Pit>& pits);

  private:
    [[nodiscard]] float lowest_above(const Pit& pit) const;

    MetreGrid& surface_;
    GridPlace place_;
    Factor factor_;
    Executor& threads_;
    AlignedGrid lowest_;
    std::vector<float> taken_out_;  ///< one per low outlier
};

}  // namespace d2b::ground
