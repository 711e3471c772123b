#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/byte_stream.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// Corner of the lattice on which outlines run, in rows and columns of the whole raster. -trace cells: a
/// corner of cells, (0, 0) is the outer corner of the first cell. -trace points: the grid point itself, (0,
/// 0) is the centre of the first cell. A unit square (or cell) is named by the corner with its smallest row
/// and column.
struct LatticePoint {
    std::int32_t row = 0;
    std::int32_t col = 0;

    friend auto operator<=>(const LatticePoint&, const LatticePoint&) = default;
};

/// Closed ring; the last point is not repeated. With y up (rows downwards), exterior rings run
/// counter-clockwise and interior rings clockwise, so the interior of the polygon is on the left.
using LatticeRing = std::vector<LatticePoint>;

/// Exterior first, then interiors.
struct LatticePolygon {
    LatticeRing exterior;
    std::vector<LatticeRing> interiors;
};

/// Point between lattice corners, in 1/1024 of a row and a column. Outlines are drawn on these points. A
/// power of two, so that coordinates computed from lattice corners and from these points are identical.
struct FinePoint {
    std::int64_t row = 0;
    std::int64_t col = 0;

    static constexpr std::int64_t steps = 1024;  ///< per cell

    friend auto operator<=>(const FinePoint&, const FinePoint&) = default;
};

/// Closed ring without repetition, interior on the left, like LatticeRing.
using FineRing = std::vector<FinePoint>;

/// Exterior first, then interiors.
struct FinePolygon {
    FineRing exterior;
    std::vector<FineRing> interiors;
    std::vector<CircularArc> arcs = {};
};

/// Straight line between two points.
struct FineSegment {
    FinePoint from;
    FinePoint to;
};

[[nodiscard]] inline FinePoint fine(LatticePoint point) {
    return {point.row * FinePoint::steps, point.col * FinePoint::steps};
}
[[nodiscard]] FineRing fine(const LatticeRing& ring);
[[nodiscard]] FinePolygon fine(const LatticePolygon& polygon);

/// Rows and columns spanned by a ring, inclusive.
struct LatticeBox {
    LatticePoint low;
    LatticePoint high;

    [[nodiscard]] bool overlaps(const LatticeBox& other) const {
        return low.row <= other.high.row && other.low.row <= high.row && low.col <= other.high.col &&
               other.low.col <= high.col;
    }
};

/// Rectilinear ring in about one byte per corner. Steps alternate between rows and columns, so one number per
/// step is enough. Starts at the first corner in scan order, so equal rings have equal bytes.
class PackedRing {
  public:
    PackedRing() = default;
    /// @param corners a simple rectilinear ring in any rotation, in which every point is a corner (at least
    /// 4)
    explicit PackedRing(const LatticeRing& corners);

    [[nodiscard]] LatticeRing corners() const;
    [[nodiscard]] LatticePoint start() const { return start_; }
    [[nodiscard]] std::uint32_t corner_count() const { return corner_count_; }
    /// Returns the number of lattice points on the ring, which is its length in steps.
    [[nodiscard]] std::int64_t points() const { return points_; }
    /// Returns the number of unit squares inside; negative for interior rings.
    [[nodiscard]] std::int64_t area() const { return area_; }
    [[nodiscard]] const LatticeBox& box() const { return box_; }

    void save(ByteWriter& writer) const;
    [[nodiscard]] static PackedRing load(ByteReader& reader);

  private:
    LatticePoint start_;
    std::uint32_t corner_count_ = 0;
    std::int64_t points_ = 0;
    std::int64_t area_ = 0;
    LatticeBox box_;
    std::vector<std::byte> steps_;  // all except the closing one, as zigzag varints
};

/// Returns true if the unit square at `square` is inside the ring. O(corners).
[[nodiscard]] bool contains(const LatticeRing& ring, LatticePoint square);

}  // namespace d2b
