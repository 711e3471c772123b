#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "dem2buildings/feature_sink.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/overlay.hpp"

namespace d2b {

/// A straight piece of an outline.
struct OutlineSegment {
    Position a;
    Position b;
};

[[nodiscard]] double squared_distance(Position p, const OutlineSegment& segment);

/// The segments of lines, found by their place.
class Segments {
  public:
    explicit Segments(std::span<const Polyline> lines);

    /// To the nearest segment; `limit` where all are farther. Lengths, not squares.
    [[nodiscard]] double distance(Position p, double limit) const;
    /// Replaces `found` by all segments that come nearer than `limit`.
    void within(Position p, double limit, std::vector<OutlineSegment>& found) const;

  private:
    std::vector<OutlineSegment> segments_;
    BoxTree tree_;
};

}  // namespace d2b
