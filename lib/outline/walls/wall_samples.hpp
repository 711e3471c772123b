#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/lattice.hpp"

namespace d2b {

/// A 2-D vector, point or direction, in cell units that preserve the angles of the ground. x is from columns,
/// y from rows.
struct Vec {
    double x = 0;
    double y = 0;

    friend Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y}; }
    friend Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y}; }
    friend Vec operator*(double f, Vec a) { return {f * a.x, f * a.y}; }
    friend bool operator==(const Vec&, const Vec&) = default;
};
[[nodiscard]] inline double dot(Vec a, Vec b) {
    return a.x * b.x + a.y * b.y;
}
[[nodiscard]] inline double cross(Vec a, Vec b) {
    return a.x * b.y - a.y * b.x;
}
[[nodiscard]] inline double length(Vec a) {
    return std::sqrt(dot(a, a));
}
/// Parameter of the point of segment ab nearest to p: 0 at a, 1 at b.
[[nodiscard]] inline double nearest_share(Vec p, Vec a, Vec b) {
    const Vec along = b - a;
    const double square = dot(along, along);
    return square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0.0;
}
/// Squared distance from a point to a segment.
[[nodiscard]] inline double square_distance(Vec p, Vec a, Vec b) {
    const Vec off = p - a - nearest_share(p, a, b) * (b - a);
    return dot(off, off);
}

/// Shape of a cell on the ground: the steps of a column and of a row, scaled so that the cell has an area of
/// 1. Angles are true in these coordinates even if cells are not square, and distances are in cells.
struct CellShape {
    Vec col{1, 0};
    Vec row{0, 1};

    [[nodiscard]] Vec from_cells(double rows, double cols) const { return cols * col + rows * row; }
    [[nodiscard]] double longer_side() const { return std::max(length(col), length(row)); }
    /// Returns the fine point nearest to a point relative to `origin`.
    [[nodiscard]] FinePoint to_fine(Vec place, LatticePoint origin) const;
    [[nodiscard]] Vec from_fine(FinePoint point, LatticePoint origin) const;
};

/// A straight line: a point and a unit direction.
struct Line {
    Vec through;
    Vec along;

    [[nodiscard]] double off(Vec p) const { return cross(along, p - through); }
    [[nodiscard]] Vec foot(Vec p) const { return through + dot(p - through, along) * along; }
};

/// Unit steps of a traced chain, relative to its first point, with prefix sums of their moments. Lines are
/// fitted to the midpoints of steps, because these lie evenly on both sides of the wall that the staircase
/// stands for. Fitting a line to any range of steps is O(1).
class WallSamples {
  public:
    /// @param trace corners and ends of a chain; a closed one does not repeat its first point
    WallSamples(const std::vector<LatticePoint>& trace, bool closed, const CellShape& shape);

    [[nodiscard]] bool closed() const { return closed_; }
    [[nodiscard]] std::size_t steps() const { return steps_; }
    /// Lattice point at the beginning of a step. Steps of closed chains wrap around.
    [[nodiscard]] Vec at(std::size_t step) const { return points_[wrap(step)]; }
    /// Calls visit(step, point) for the corners and ends in [first, last], until it returns false.
    template <typename Visit>
    void for_corners(std::size_t first, std::size_t last, const Visit& visit) const {
        std::size_t lap = first - wrap(first);
        for (std::size_t k = corner_at_[first - lap];; ++k) {
            if (k == corner_steps_.size()) {
                if (!closed_)
                    return;
                k = 0;
                lap += steps_;
            }
            const std::size_t step = corner_steps_[k];
            if (step + lap > last || !visit(step + lap, points_[step]))
                return;
        }
    }

    /// Centers of two adjacent cells.
    struct Cells {
        Vec left;
        Vec right;
    };
    /// Cells on both sides of a step. A ring has its interior on the left.
    [[nodiscard]] Cells beside(std::size_t step) const;
    /// Direction rotated by 90 degrees to the left. If rows run north, this is the right on the ground.
    [[nodiscard]] Vec left_of(Vec along) const {
        return mirrored() ? Vec{along.y, -along.x} : Vec{-along.y, along.x};
    }
    [[nodiscard]] bool mirrored() const { return cross(shape_.col, shape_.row) > 0; }

    struct Sums {
        double n = 0;
        Vec mean;
        double xx = 0;  ///< about the mean
        double xy = 0;
        double yy = 0;
        /// Sum of squared distances from the line through the mean.
        [[nodiscard]] double squares(Vec along) const {
            return along.y * along.y * xx - 2 * along.x * along.y * xy + along.x * along.x * yy;
        }
        [[nodiscard]] double least_squares() const {
            return std::max(0.0, (xx + yy - std::sqrt((xx - yy) * (xx - yy) + 4 * xy * xy)) / 2);
        }
        /// Direction with the smallest sum of squares.
        [[nodiscard]] Vec direction() const;
    };
    /// Sums over the midpoints of steps first .. last - 1; last <= first + steps() and < 2 * steps().
    [[nodiscard]] Sums sums(std::size_t first, std::size_t last) const;
    /// Returns true if the trace between two steps stays within `limit` of a line.
    [[nodiscard]] bool near(std::size_t first, std::size_t last, const Line& line, double limit) const;

  private:
    using Moments = std::array<double, 5>;  // x, y, xx, xy, yy
    [[nodiscard]] std::size_t wrap(std::size_t step) const {
        while (closed_ && step >= steps_)
            step -= steps_;
        return step;
    }
    void add_edge(LatticePoint from, LatticePoint to);
    void add_up();

    bool closed_;
    CellShape shape_;
    LatticePoint origin_;
    std::size_t steps_ = 0;
    std::vector<Vec> points_;
    std::vector<std::uint32_t> corner_steps_;
    std::vector<std::uint32_t> corner_at_;  // index of the first corner at or after each step
    std::vector<Moments> running_;          // prefix sums over the steps before each one
};

}  // namespace d2b
