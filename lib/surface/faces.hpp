#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "surface/planar_partition.hpp"

namespace d2b::surface {

/// Polygon of nodes: exterior counter-clockwise (y up), interiors clockwise. Rings do not touch themselves
/// and touch each other only in single nodes.
struct PartitionFace {
    std::vector<std::uint32_t> exterior;
    std::vector<std::vector<std::uint32_t>> interiors;

    friend auto operator<=>(const PartitionFace&, const PartitionFace&) = default;
};

/// Face and its topmost contour.
struct OwnedFace {
    std::int32_t owner = open_ground;
    PartitionFace face;
};

/// Returns the faces of a plan, except the outside, by ascending owners.
[[nodiscard]] std::vector<OwnedFace> partition_faces(const PlanarPartition& plan);

/// Returns the face as a polygon on the lattice. @param plan that the face belongs to
[[nodiscard]] FinePolygon polygon_of(const PartitionFace& face, const PlanarPartition& plan);

/// Divides a face along diagonals into y-monotone pieces without interiors (de Berg, Cheong, van Kreveld and
/// Overmars 2008, 3.2). Exact. O(n log n), except for shifting the vector of edges on the sweep line. @param
/// face whose rings do not touch
[[nodiscard]] std::vector<PartitionFace> split_into_monotone(const PartitionFace& face,
                                                             const PlanarPartition& plan);

/// Three vertices, in either orientation.
using FineTriangle = std::array<FinePoint, 3>;

/// Triangulates a polygon without new vertices. May throw GeometryError, and may be wrong.
using Triangulate = std::function<std::vector<FineTriangle>(const FinePolygon& polygon)>;

/// Three nodes, counter-clockwise (y up).
using PartitionTriangle = std::array<std::uint32_t, 3>;

/// Triangulates a face and verifies the result: every triangle has an area, and after cancelling edges
/// traversed in both directions exactly the face's boundary remains. Retries with rows and columns swapped,
/// then in y-monotone pieces. @return nothing if everything fails
[[nodiscard]] std::optional<std::vector<PartitionTriangle>> triangulate_face(const PartitionFace& face,
                                                                             const PlanarPartition& plan,
                                                                             const Triangulate& triangulate);

}  // namespace d2b::surface
