#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/grid.hpp"
#include "core/lattice.hpp"

namespace d2b::surface {

/// Plane of a slanted roof, in steps of height.
struct RoofPlane {
    FinePoint at;
    double height = 0;    ///< at this point
    double per_row = 0;   ///< rise per step southwards
    double per_col = 0;   ///< rise per step eastwards
    double cosine = 1;    ///< of its slope on the ground
    double row_step = 1;  ///< length of a step southwards on the ground, in steps of height
    double col_step = 1;  ///< and of one eastwards

    [[nodiscard]] double height_at(double row, double col) const {
        return height + (row - static_cast<double>(at.row)) * per_row +
               (col - static_cast<double>(at.col)) * per_col;
    }
};

/// Contour to build a surface from. Outlines lie on the surface's lattice: columns are steps to the east,
/// rows are steps to the south, heights are steps upwards.
struct PartitionContour {
    FinePolygon outline;
    std::int32_t parent = -1;   ///< index of the contour that it stands on, which comes before it; -1: none
    std::int32_t building = 0;  ///< index of its building
    std::int64_t top = 0;       ///< height of its roof outside its children; with a plane its lowest corner
    std::optional<RoofPlane> plane = {};  ///< of its roof; nullopt: level
};

/// Stands for a contour: nothing is built there.
inline constexpr std::int32_t open_ground = -1;

/// Part of the boundary between two areas: straight, and touching other edges only at its ends.
struct PartitionEdge {
    std::uint32_t from = 0;  ///< node
    std::uint32_t to = 0;
    std::int32_t left = open_ground;  ///< topmost contour on this side; never equal to right
    std::int32_t right = open_ground;

    friend auto operator<=>(const PartitionEdge&, const PartitionEdge&) = default;
};

/// Planar partition by topmost contour.
struct PlanarPartition {
    std::vector<FinePoint> nodes;  ///< distinct
    std::vector<PartitionEdge> edges;
};

/// Minimum distance on the lattice: points are separated if one is outside the box of this size around the
/// other.
struct LatticeDistance {
    std::int64_t rows = 1;
    std::int64_t cols = 1;

    [[nodiscard]] bool parts(FinePoint a, FinePoint b) const {
        return std::abs(a.row - b.row) >= rows || std::abs(a.col - b.col) >= cols;
    }
    friend bool operator==(const LatticeDistance&, const LatticeDistance&) = default;
};

/// Returns the larger value of each side.
[[nodiscard]] inline LatticeDistance componentwise_max(const LatticeDistance& a, const LatticeDistance& b) {
    return {std::max(a.rows, b.rows), std::max(a.cols, b.cols)};
}

/// Returns the box outside of which all points are at least `metres` away on the ground, rounded up to whole
/// steps. @param metres above 0 @param cell a column and a row of FinePoint::steps, at any angle
[[nodiscard]] LatticeDistance lattice_distance(double metres, const CellSize& cell);

/// Minimum distances between the corners of a surface. The defaults are for a lattice of unknown cell size.
struct GapTolerances {
    /// Distance between corners that touched. Ten times the millimetre within which programs that read solids
    /// merge vertices (the default of val3dity and others).
    static constexpr double pinch_m = 0.01;
    /// Corners closer than this are merged beforehand.
    static constexpr double corner_m = 0.002;

    LatticeDistance pinch{2, 2};
    LatticeDistance corners{1, 1};
    std::int64_t heights = 1;  ///< millimetres between roofs that meet and between a roof and its base

    /// Returns true if there is a solid between two heights.
    [[nodiscard]] bool rises_above(std::int64_t top, std::int64_t base) const {
        return top >= base + heights;
    }
};
[[nodiscard]] GapTolerances gap_tolerances(const CellSize& cell);

/// Edge as seen from one of its ends (a half-edge).
struct IncidentEdge {
    std::uint32_t edge = 0;
    std::uint32_t end = 0;  ///< node at the other end
    std::int32_t left = open_ground;
    std::int32_t right = open_ground;
};

/// Returns an edge as seen from one of its ends. @param e its number
[[nodiscard]] inline IncidentEdge seen_from(std::uint32_t node, std::uint32_t e, const PartitionEdge& edge) {
    return edge.from == node ? IncidentEdge{e, edge.to, edge.left, edge.right}
                             : IncidentEdge{e, edge.from, edge.right, edge.left};
}

/// Sorts the edges at a node counter-clockwise (y up). @param arms in any order
void sort_around(const std::vector<FinePoint>& nodes, std::uint32_t node, std::vector<IncidentEdge>& arms);

/// Returns the edges around each node of a plan, counter-clockwise.
[[nodiscard]] std::vector<std::vector<IncidentEdge>> edges_around_nodes(const PlanarPartition& plan);

/// Returns a plan of edges between nodes of another plan, whose other nodes are left out. O(n log n) in the
/// number of edges.
[[nodiscard]] PlanarPartition plan_of(std::vector<PartitionEdge> edges, const std::vector<FinePoint>& nodes);

/// True if a contour is, or stands on, another one; all stand on open_ground.
[[nodiscard]] bool is_on(std::int32_t contour, std::int32_t below,
                         std::span<const PartitionContour> contours);

enum class Straighten {
    all,    ///< every node between two collinear edges
    inside  ///< only nodes that do not touch the outside, because walls stand on the others
};

/// Merges collinear edges at nodes of degree two. Node numbers do not change; unused nodes stay in the list.
/// @param kept positions of nodes that stay, sorted
void straighten(PlanarPartition& plan, Straighten what, std::span<const FinePoint> kept = {});

/// Extracts the plan of some contours as if the others did not exist: they become outside, and nodes between
/// collinear edges are removed. O(n log n) in the given edges. @param edges of the plan, all that bound these
/// contours @param belongs true if a contour is one of them @param kept positions of nodes that stay, sorted
[[nodiscard]] PlanarPartition extract_partition(const PlanarPartition& plan,
                                                std::span<const std::uint32_t> edges,
                                                const std::function<bool(std::int32_t)>& belongs,
                                                std::span<const FinePoint> kept = {});

}  // namespace d2b::surface
