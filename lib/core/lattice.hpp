#pragma once

#include <cstdint>
#include <vector>

#include "core/byte_record.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// A corner of the lattice on which outlines run, in rows and columns of the whole raster.
/// -trace cells: the corner of cells, (0, 0) is the outer corner of the first cell.
/// -trace points: the grid point itself, (0, 0) is the centre of the first cell.
/// Also names a unit square (or cell) by its first corner, the one with the smallest row and column.
struct LatticePoint {
    std::int32_t row = 0;
    std::int32_t col = 0;

    friend auto operator<=>(const LatticePoint&, const LatticePoint&) = default;
};

/// A closed ring; the last point is not repeated. Seen with y up (rows downwards), exterior rings run
/// counter-clockwise and interior rings clockwise: what they bound lies on the left.
using LatticeRing = std::vector<LatticePoint>;

/// exterior first, then interiors
struct LatticePolygon {
    LatticeRing exterior;
    std::vector<LatticeRing> interiors;
};

/// A point between the corners of the lattice, in 1024ths of a row and a column. Outlines are drawn on these:
/// a power of two, so that a corner is the same number in coordinates whether it comes from here or from
/// there.
struct FinePoint {
    std::int64_t row = 0;
    std::int64_t col = 0;

    static constexpr std::int64_t steps = 1024;  ///< in a cell

    friend auto operator<=>(const FinePoint&, const FinePoint&) = default;
};

/// As a LatticeRing: closed without repetition, what it bounds on its left.
using FineRing = std::vector<FinePoint>;

/// exterior first, then interiors
struct FinePolygon {
    FineRing exterior;
    std::vector<FineRing> interiors;
    std::vector<CircularArc> arcs = {};
};

[[nodiscard]] inline FinePoint fine(LatticePoint point) {
    return {point.row * FinePoint::steps, point.col * FinePoint::steps};
}
[[nodiscard]] FineRing fine(const LatticeRing& ring);
[[nodiscard]] FinePolygon fine(const LatticePolygon& polygon);

/// Rows and columns that a ring spans, inclusive.
struct LatticeBox {
    LatticePoint low;
    LatticePoint high;

    [[nodiscard]] bool overlaps(const LatticeBox& other) const {
        return low.row <= other.high.row && other.low.row <= high.row && low.col <= other.high.col &&
               other.low.col <= high.col;
    }
};

/// A rectilinear ring in about one byte a corner: its corners alternate between steps along a row and along a
/// column, so a step is one number. It starts at its first corner in scan order, so equal rings are equal
/// bytes.
class PackedRing {
  public:
    PackedRing() = default;
    /// @param corners a simple rectilinear ring whose every point is a corner (at least 4), in any rotation
    explicit PackedRing(const LatticeRing& corners);

    [[nodiscard]] LatticeRing corners() const;
    [[nodiscard]] LatticePoint start() const { return start_; }
    [[nodiscard]] std::uint32_t corner_count() const { return corner_count_; }
    /// Lattice points that the ring passes, which is its length in steps.
    [[nodiscard]] std::int64_t points() const { return points_; }
    /// Unit squares inside; negative for interior rings.
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
    std::vector<std::uint8_t> steps_;  // all but the closing one, zigzag varints
};

/// Whether the unit square at `square` lies inside a ring: O(corners).
[[nodiscard]] bool contains(const LatticeRing& ring, LatticePoint square);

}  // namespace d2b
