#pragma once

#include <memory>
#include <span>
#include <vector>

#include "dem2buildings/world_polygon.hpp"
#include "geometry/overlay.hpp"

namespace d2b {

/// A straight piece of an outline.
struct OutlineSegment {
    Position a;
    Position b;
};

[[nodiscard]] double squared_distance(Position p, const OutlineSegment& segment);

/// The segments of lines, found by their place: Boost's R-tree.
class OutlineSegments {
  public:
    explicit OutlineSegments(std::span<const Polyline> lines);
    ~OutlineSegments();
    OutlineSegments(const OutlineSegments&) = delete;
    OutlineSegments& operator=(const OutlineSegments&) = delete;

    /// To the nearest segment; `limit` where all are farther. Lengths, not squares.
    [[nodiscard]] double distance(Position p, double limit) const;
    /// Replaces `found` by all segments that come nearer than `limit`.
    void within(Position p, double limit, std::vector<OutlineSegment>& found) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b
