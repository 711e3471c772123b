#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/int128.hpp"
#include "core/lattice.hpp"

namespace d2b::outline {

/// Twice the signed area of a triangle, positive if a, b, c are counter-clockwise with y up. Exact.
[[nodiscard]] inline Int128 turn(FinePoint a, FinePoint b, FinePoint c) {
    return static_cast<Int128>(b.row - a.row) * (c.col - a.col) -
           static_cast<Int128>(b.col - a.col) * (c.row - a.row);
}

/// Twice the signed area of a ring in fine squares, exact.
[[nodiscard]] inline Int128 twice_area(const FineRing& ring) {
    Int128 sum = 0;
    for (std::size_t i = 2; i < ring.size(); ++i)
        sum += turn(ring[0], ring[i - 1], ring[i]);
    return sum;
}

[[nodiscard]] inline int sign(Int128 value) {
    return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

/// Orientation predicate: the sign of turn(a, b, c). Exact; fast if the points are within a million cells.
[[nodiscard]] inline int side(FinePoint a, FinePoint b, FinePoint c) {
    const std::int64_t rows_b = b.row - a.row;
    const std::int64_t cols_b = b.col - a.col;
    const std::int64_t rows_c = c.row - a.row;
    const std::int64_t cols_c = c.col - a.col;
    constexpr std::int64_t small = std::int64_t{1} << 30;
    const auto fits = [](std::int64_t v) { return v < small && v > -small; };
    if (!fits(rows_b) || !fits(cols_b) || !fits(rows_c) || !fits(cols_c))
        return sign(turn(a, b, c));
    const std::int64_t twice = rows_b * cols_c - cols_b * rows_c;
    return twice > 0 ? 1 : (twice < 0 ? -1 : 0);
}

[[nodiscard]] inline bool boxes_intersect(const FineSegment& s, const FineSegment& t) {
    return std::max(s.from.row, s.to.row) >= std::min(t.from.row, t.to.row) &&
           std::max(t.from.row, t.to.row) >= std::min(s.from.row, s.to.row) &&
           std::max(s.from.col, s.to.col) >= std::min(t.from.col, t.to.col) &&
           std::max(t.from.col, t.to.col) >= std::min(s.from.col, s.to.col);
}

/// Returns true if two segments intersect, ends included. Exact.
[[nodiscard]] inline bool segments_intersect(const FineSegment& s, const FineSegment& t) {
    if (!boxes_intersect(s, t))
        return false;
    const int a = side(s.from, s.to, t.from);
    const int b = side(s.from, s.to, t.to);
    // Collinear segments intersect if their boxes do.
    if (a == 0 && b == 0)
        return true;
    return a * b <= 0 && side(t.from, t.to, s.from) * side(t.from, t.to, s.to) <= 0;
}

/// Returns true if two segments from a common point share another point. Exact.
[[nodiscard]] inline bool overlap_from(FinePoint common, FinePoint s, FinePoint t) {
    if (side(common, s, t) != 0)
        return false;
    return static_cast<Int128>(s.row - common.row) * (t.row - common.row) +
               static_cast<Int128>(s.col - common.col) * (t.col - common.col) >
           0;
}

/// Angular comparison around a point: true if `to` precedes `than` counter-clockwise (y up) from due west.
/// Exact.
[[nodiscard]] inline bool precedes_ccw(FinePoint from, FinePoint to, FinePoint than) {
    // Counter-clockwise from west come south, east, north, so west and everything below it is the first half.
    const auto half = [&](FinePoint p) {
        return p.row > from.row || (p.row == from.row && p.col < from.col) ? 0 : 1;
    };
    return half(to) != half(than) ? half(to) < half(than) : side(from, to, than) > 0;
}

/// Returns true for points in a closed triangle; a degenerate one is its longest side. Exact.
[[nodiscard]] inline bool in_triangle(FinePoint a, FinePoint b, FinePoint c, FinePoint point) {
    const int s = side(a, b, c);
    if (s == 0) {
        const auto [low_row, high_row] = std::minmax({a.row, b.row, c.row});
        const auto [low_col, high_col] = std::minmax({a.col, b.col, c.col});
        return side(a, b, point) == 0 && side(b, c, point) == 0 && side(c, a, point) == 0 &&
               point.row >= low_row && point.row <= high_row && point.col >= low_col && point.col <= high_col;
    }
    return s * side(a, b, point) >= 0 && s * side(b, c, point) >= 0 && s * side(c, a, point) >= 0;
}

/// Point at a share of the way from one point to another, rounded to the lattice.
[[nodiscard]] inline FinePoint point_between(FinePoint from, FinePoint to, double share) {
    return {from.row + std::llround(share * static_cast<double>(to.row - from.row)),
            from.col + std::llround(share * static_cast<double>(to.col - from.col))};
}

/// Distance in steps of the lattice.
[[nodiscard]] inline double step_distance(FinePoint a, FinePoint b) {
    return std::hypot(static_cast<double>(b.row - a.row), static_cast<double>(b.col - a.col));
}

}  // namespace d2b::outline
