#pragma once

#include <vector>

#include "outline/walls/outline_builder.hpp"
#include "outline/walls/ring_areas.hpp"
#include "outline/walls/wall_drawing.hpp"

namespace d2b {

/// Builds the outlines of the contours of a cluster from their drawn chains.
class DrawnOutlines {
  public:
    /// @param graph, drawing, areas must outlive this
    DrawnOutlines(const WallGraph& graph, const WallDrawing& drawing, const RingAreas& areas,
                  const WallOptions& options)
        : graph_(graph), drawing_(drawing), areas_(areas), options_(options) {}

    [[nodiscard]] WallOutline outline(std::size_t contour) const;
    /// Outline of a contour of level 0 or 1, without vertices that only higher levels need.
    [[nodiscard]] WallOutline footprint(std::size_t contour) const;

  private:
    [[nodiscard]] bool low_levels_meet(const ArcUse& before, const ArcUse& after) const;
    void add_low(const std::vector<ArcUse>& uses, OutlineBuilder& builder) const;

    const WallGraph& graph_;
    const WallDrawing& drawing_;
    const RingAreas& areas_;
    WallOptions options_;
};

}  // namespace d2b
