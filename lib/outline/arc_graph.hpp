#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "contours/contour.hpp"
#include "core/lattice.hpp"
#include "core/stop_token.hpp"

namespace d2b::outline {

/// Rings of contours whose edges end at all corners of other rings on them. Compression may leave a corner of
/// one outline in the middle of an edge of another on a shared wall. Noding inserts it into both, because
/// otherwise rounding, reprojection or simplification could separate the shared edge. O(n log n) in the
/// number of vertices.
class NodedRings {
  public:
    using Vertex = std::uint32_t;
    /// Directions from a vertex; opposite directions differ by 2.
    enum class Direction : std::uint8_t { east, south, west, north };

    /// @throws Cancelled
    explicit NodedRings(const std::vector<contours::Contour>& contours, const StopToken& stop = {});

    [[nodiscard]] std::size_t contours() const { return first_ring_.size() - 1; }
    [[nodiscard]] LatticePolygon polygon(std::size_t contour) const;
    /// Rings of a contour, its exterior first: [first_ring(contour), first_ring(contour + 1)).
    [[nodiscard]] std::size_t first_ring(std::size_t contour) const { return first_ring_[contour]; }
    [[nodiscard]] std::span<const Vertex> ring(std::size_t r) const {
        return std::span(vertices_).subspan(first_[r], first_[r + 1] - first_[r]);
    }

    /// Number of vertices, which are sorted by row, then column.
    [[nodiscard]] std::size_t size() const { return points_.size(); }
    [[nodiscard]] LatticePoint point(Vertex v) const { return points_[v]; }
    /// True if the degree of the vertex is not two.
    [[nodiscard]] bool junction(Vertex v) const { return degree_two.at(directions_[v]) == 0; }
    [[nodiscard]] Direction direction(Vertex from, Vertex to) const;

  private:
    static constexpr std::array<std::uint8_t, 16> degree_two{0, 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1, 0, 0, 0};
    std::vector<Vertex> number_corners(const std::vector<LatticePoint>& corners, const StopToken& stop);
    /// Vertices sorted by column, then row.
    struct Columns {
        std::vector<Vertex> vertices;
        std::vector<Vertex> places;  // per vertex: its index in this order
    };
    [[nodiscard]] Columns columns() const;
    void append_edge(Vertex from, Vertex to, const Columns& columns);

    std::vector<LatticePoint> points_;
    std::vector<std::uint8_t> directions_;  // per vertex: bits of the directions of its edges
    std::vector<Vertex> vertices_;          // concatenated vertices of all rings
    std::vector<std::size_t> first_;        // per ring: its first vertex
    std::vector<std::size_t> first_ring_;   // per contour
};

/// A path of an outline between two junctions, or a ring without junctions (its first point is then repeated
/// at the end). Neighbours and levels share the arc object, so an edit applies to all of them.
using Arc = std::vector<LatticePoint>;

/// Oriented use of an arc by a ring.
struct ArcUse {
    std::uint32_t arc = 0;
    bool reversed = false;
};

/// Outlines of all contours as one planar graph.
struct ArcGraph {
    struct Outline {
        std::vector<ArcUse> exterior;
        std::vector<std::vector<ArcUse>> interiors;
    };
    std::vector<Arc> arcs;
    std::vector<Outline> outlines;  ///< one per contour

    /// Assembles the outline of a contour from the current arcs.
    [[nodiscard]] LatticePolygon polygon(std::size_t contour) const;
};

/// Splits noded outlines into arcs at junctions, i.e. points with a degree other than two. @throws Cancelled
[[nodiscard]] ArcGraph build_arc_graph(const NodedRings& rings, const StopToken& stop = {});

}  // namespace d2b::outline
