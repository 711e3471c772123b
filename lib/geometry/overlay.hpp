#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// Polygons of one feature or area. Areas must be valid and disjoint; returned polygons are.
using Polygons = std::vector<WorldPolygon>;
using Polyline = std::vector<Position>;

/// Coverage of several features.
struct Dissolved {
    Polygons once;   ///< union; parts that only touch in points are separate
    Polygons twice;  ///< area covered by two or more features
};

/// GEOS overlay operations on areas; one object per thread. Calls cannot be cancelled, so use Geos for
/// polygons of the size of a raster. All throw Error with the message of GEOS on failure.
class Overlay {
  public:
    Overlay();
    Overlay(Overlay&&) noexcept;
    Overlay& operator=(Overlay&&) noexcept;
    ~Overlay();

    /// True if a feature is a valid MultiPolygon with finite coordinates.
    [[nodiscard]] bool valid(const Polygons& feature);
    /// Repairs an invalid feature with GEOS's structural repair: the area inside its exterior rings and
    /// outside their holes. Drops degenerate rings and non-finite positions; the result may be empty.
    [[nodiscard]] Polygons make_valid(const Polygons& feature);
    /// @param features each valid; may be empty
    [[nodiscard]] Dissolved dissolve(std::span<const Polygons> features);
    /// Computes only the union, in half the time. @param features each valid; may be empty
    [[nodiscard]] Polygons union_of(std::span<const Polygons> features);
    /// Union of polygons that may be invalid and overlap.
    [[nodiscard]] Polygons repaired_union(std::span<const WorldPolygon> polygons);
    [[nodiscard]] Polygons intersection(const Polygons& a, const Polygons& b);
    /// Closed rings of an area, clipped to another area including its border.
    [[nodiscard]] std::vector<Polyline> clip_rings(const Polygons& area, const Polygons& other);
    /// Per feature: true if it intersects an area. @param features each valid
    [[nodiscard]] std::vector<bool> intersecting(std::span<const Polygons> features, const Polygons& area);
    /// Per inner polygon: index of the outer polygon that contains an interior point of it, if any.
    /// @param outers must not overlap
    [[nodiscard]] std::vector<std::optional<std::size_t>> containing_polygons(
        std::span<const WorldPolygon> inners, std::span<const WorldPolygon> outers);
    /// Number of vertices of a feature after topology-preserving simplification, closing vertices included.
    /// @param feature valid
    [[nodiscard]] std::size_t simplified_vertices(const Polygons& feature, double tolerance);
    /// Topology-preserving simplification of one ring, whose first vertex is kept.
    [[nodiscard]] WorldRing simplified_ring(const WorldRing& ring, double tolerance);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b
