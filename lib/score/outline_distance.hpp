#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dem2buildings/sinks.hpp"
#include "dem2buildings/world_polygon.hpp"
#include "geometry/overlay.hpp"

namespace d2b::score {

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

/// Distance of an outline from a reference, in units of the coordinates.
struct OutlineDistance {
    double length = 0;          ///< length of the measured outline
    double near = 0;            ///< length within the limit of the reference
    std::optional<double> rms;  ///< over that length; nullopt if it is 0
};

/// Samples `outline` at most every `step` and measures distances to the nearest point of `reference`.
/// @param limit points farther than this from the reference are ignored
[[nodiscard]] OutlineDistance outline_distance(std::span<const Polyline> outline,
                                               std::span<const Polyline> reference, double limit,
                                               double step);

/// PoLiS distance (Avbelj, Mueller, Bamler 2015): half the mean distance of the vertices of each polygon to
/// the outline of the other, summed over both directions. In units of the coordinates; includes interior
/// rings.
[[nodiscard]] double polis_distance(const WorldPolygon& a, const WorldPolygon& b);

}  // namespace d2b::score
