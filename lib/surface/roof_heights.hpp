#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "surface/faces.hpp"
#include "surface/planar_partition.hpp"

namespace d2b::surface {

/// Height of open ground: below all roofs.
inline constexpr std::int64_t no_height = std::numeric_limits<std::int64_t>::min();

/// Row, column and height.
using RoofCorner = std::array<double, 3>;

/// Returns the plane that fits points best. @param points at least three
[[nodiscard]] RoofPlane fit_plane(std::span<const RoofCorner> points);

/// Returns the angle between a plane and a triangle on the ground, in degrees. @param corners not on a line
/// in plan
[[nodiscard]] double angle_between(const RoofPlane& plane, const std::array<RoofCorner, 3>& corners);

/// Returns true if a program that divides a face into triangles may get one that turns away from its plane.
/// @param triangles Delaunay triangulation of the face in plan @param corner_at place of a node
[[nodiscard]] bool is_twisted(const RoofPlane& plane, const PartitionFace& face,
                              std::span<const PartitionTriangle> triangles,
                              const std::function<RoofCorner(std::uint32_t node)>& corner_at);

/// Returns the height of each contour's roof at a node. Planes that nearly meet there get one height,
/// because rounding has moved the corners in which they meet; others are at least two millimetres apart.
/// @param around contours and open_ground, all that touch the node
[[nodiscard]] std::vector<std::int64_t> heights_at(double row, double col,
                                                   std::span<const std::int32_t> around,
                                                   std::span<const PartitionContour> contours);
[[nodiscard]] inline std::vector<std::int64_t> heights_at(FinePoint node,
                                                          std::span<const std::int32_t> around,
                                                          std::span<const PartitionContour> contours) {
    return heights_at(static_cast<double>(node.row), static_cast<double>(node.col), around, contours);
}

/// Adds nodes where the roofs on both sides of an edge cross each other. @return their positions, sorted
[[nodiscard]] std::vector<FinePoint> split_crossings(PlanarPartition& plan,
                                                     std::span<const PartitionContour> contours);

/// Heights of roofs at the nodes of a plan.
class RoofHeights {
  public:
    RoofHeights() = default;
    RoofHeights(const PlanarPartition& plan, std::span<const PartitionContour> contours);

    /// @param contour next to the node; not open_ground
    [[nodiscard]] std::int64_t at(std::int32_t contour, FinePoint node) const;
    [[nodiscard]] bool are_slanted() const { return !entries_.empty(); }
    /// Makes roofs equal at the ends of edges next to which they cross. @return contours on both sides of
    /// edges on which they still cross, ascending
    [[nodiscard]] std::vector<std::int32_t> join_near_crossings(const PlanarPartition& plan);
    /// Returns the contours whose roof has a corner more than a step from the plane that fits its corners
    /// best, because it meets other roofs. Ascending.
    [[nodiscard]] std::vector<std::int32_t> uneven_roofs(std::span<const PartitionContour> contours) const;

  private:
    /// Height of a slanted roof or of one that meets it.
    struct Entry {
        FinePoint node;
        std::int32_t contour = 0;
        std::int64_t height = 0;

        friend auto operator<=>(const Entry&, const Entry&) = default;
    };
    [[nodiscard]] std::span<Entry> entries_at(FinePoint node);
    void join(FinePoint node, std::int32_t a, std::int32_t b);

    std::vector<std::int64_t> tops_;  // by contour
    std::vector<Entry> entries_;      // sorted; only of nodes with a plane
};

}  // namespace d2b::surface
