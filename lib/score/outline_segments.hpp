#pragma once

#include <memory>
#include <span>
#include <vector>

#include "dem2buildings/world_polygon.hpp"
#include "geometry/overlay.hpp"

namespace d2b {

/// Straight segment of an outline.
struct OutlineSegment {
    Position a;
    Position b;
};

[[nodiscard]] double squared_distance(Position p, const OutlineSegment& segment);

/// Spatial index of the segments of lines: Boost's R-tree.
class OutlineSegments {
  public:
    explicit OutlineSegments(std::span<const Polyline> lines);
    ~OutlineSegments();
    OutlineSegments(const OutlineSegments&) = delete;
    OutlineSegments& operator=(const OutlineSegments&) = delete;

    /// Distance to the nearest segment; `limit` if all are farther.
    [[nodiscard]] double distance(Position p, double limit) const;
    /// Replaces `found` with all segments nearer than `limit`.
    void within(Position p, double limit, std::vector<OutlineSegment>& found) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b
