#include "outline/vertex_grid.hpp"

#include <algorithm>

namespace d2b {
namespace {

/// Twice the signed area of a triangle; exact because rows and columns differ by less than 2^31.
std::int64_t turn(LatticePoint a, LatticePoint b, LatticePoint c) {
    const auto rows_b = static_cast<std::int64_t>(b.row) - a.row;
    const auto cols_b = static_cast<std::int64_t>(b.col) - a.col;
    const auto rows_c = static_cast<std::int64_t>(c.row) - a.row;
    const auto cols_c = static_cast<std::int64_t>(c.col) - a.col;
    return cols_b * rows_c - rows_b * cols_c;
}

/// Returns true for points in the closed triangle; a degenerate one is its longest side.
bool inside(LatticePoint p, LatticePoint a, LatticePoint b, LatticePoint c) {
    const std::int64_t ab = turn(a, b, p);
    const std::int64_t bc = turn(b, c, p);
    const std::int64_t ca = turn(c, a, p);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

}  // namespace

void VertexGrid::remove(LatticePoint point) {
    auto& points = buckets_[bucket(point.row >> shift, point.col >> shift)];
    const auto found = std::find(points.begin(), points.end(), point);
    *found = points.back();
    points.pop_back();
}

bool VertexGrid::any_in(LatticePoint a, LatticePoint b, LatticePoint c) const {
    const LatticePoint low{std::min({a.row, b.row, c.row}), std::min({a.col, b.col, c.col})};
    const LatticePoint high{std::max({a.row, b.row, c.row}), std::max({a.col, b.col, c.col})};
    for (std::int32_t row = low.row >> shift; row <= high.row >> shift; ++row)
        for (std::int32_t col = low.col >> shift; col <= high.col >> shift; ++col) {
            const auto found = buckets_.find(bucket(row, col));
            if (found == buckets_.end())
                continue;
            for (const LatticePoint p : found->second)
                if (p != a && p != b && p != c && p.row >= low.row && p.col >= low.col && p.col <= high.col &&
                    p.row <= high.row && inside(p, a, b, c))
                    return true;
        }
    return false;
}

}  // namespace d2b
