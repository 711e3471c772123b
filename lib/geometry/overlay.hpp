#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// The polygons of one feature or one area. Where a function takes an area, they must be valid and must not
/// overlap; what functions return is so.
using Polygons = std::vector<WorldPolygon>;
using Polyline = std::vector<Position>;

/// What several features cover.
struct Dissolved {
    Polygons once;   ///< the union; pieces that only touch in points are separate
    Polygons twice;  ///< what two or more features cover
};

/// Operations of GEOS on areas; one object per thread. All throw Error with GEOS's message where GEOS fails.
class Overlay {
  public:
    Overlay();
    Overlay(Overlay&&) noexcept;
    Overlay& operator=(Overlay&&) noexcept;
    ~Overlay();

    /// Whether a feature is a valid MultiPolygon of finite coordinates.
    [[nodiscard]] bool valid(const Polygons& feature);
    /// The area of a feature that is not valid: what an odd number of times lies within its rings. Rings that
    /// bound nothing and positions that are not finite are left out; may be empty.
    [[nodiscard]] Polygons made_valid(const Polygons& feature);
    /// @param features each valid; may be empty
    [[nodiscard]] Dissolved dissolve(std::span<const Polygons> features);
    /// The union alone, which takes half the time. @param features each valid; may be empty
    [[nodiscard]] Polygons union_of(std::span<const Polygons> features);
    /// The area of polygons that may be invalid and overlap.
    [[nodiscard]] Polygons repaired_union(std::span<const WorldPolygon> polygons);
    [[nodiscard]] Polygons intersection(const Polygons& a, const Polygons& b);
    /// The rings of an area, closed, as far as they lie in or on the border of another.
    [[nodiscard]] std::vector<Polyline> rings_within(const Polygons& area, const Polygons& other);
    /// Which features share a point with an area. @param features each valid
    [[nodiscard]] std::vector<bool> touching(std::span<const Polygons> features, const Polygons& area);
    /// For each inner polygon the one of `outers` that holds a point of its inside; nothing where none does.
    /// @param outers must not overlap
    [[nodiscard]] std::vector<std::optional<std::size_t>> holders(std::span<const WorldPolygon> inners,
                                                                  std::span<const WorldPolygon> outers);
    /// Vertices that are left of a feature where a simplification that keeps its topology may move its
    /// outline by a tolerance; closing vertices count. @param feature valid
    [[nodiscard]] std::size_t simplified_vertices(const Polygons& feature, double tolerance);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b
