#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/lattice.hpp"
#include "geometry/vec2.hpp"

namespace d2b::outline {

/// Shape of a cell on the ground: the steps of a column and of a row, scaled so that the cell has an area of
/// 1. Angles are true in these coordinates even if cells are not square, and distances are in cells. x is
/// from columns, y from rows.
struct CellShape {
    Vec2 col{1, 0};
    Vec2 row{0, 1};

    [[nodiscard]] Vec2 from_cells(double rows, double cols) const { return cols * col + rows * row; }
    [[nodiscard]] double longer_side() const { return std::max(length(col), length(row)); }
    /// Returns the fine point nearest to a point relative to `origin`.
    [[nodiscard]] FinePoint to_fine(Vec2 place, LatticePoint origin) const;
    [[nodiscard]] Vec2 from_fine(FinePoint point, LatticePoint origin) const;
};

/// A straight line: a point and a unit direction.
struct Line2 {
    Vec2 through;
    Vec2 along;

    [[nodiscard]] double offset(Vec2 p) const { return cross(along, p - through); }
    [[nodiscard]] Vec2 project(Vec2 p) const { return through + dot(p - through, along) * along; }
};

/// Point at which two lines cross. @return nullopt if the sine of their angle is less than `min_sine`
[[nodiscard]] inline std::optional<Vec2> crossing(const Line2& a, const Line2& b, double min_sine) {
    const double sine = cross(a.along, b.along);
    if (std::abs(sine) < min_sine)
        return {};
    return a.through + cross(b.through - a.through, b.along) / sine * a.along;
}

/// Unit steps of a traced chain, relative to its first point, with prefix sums of their moments. Lines are
/// fitted to the midpoints of steps, because these lie evenly on both sides of the wall that the staircase
/// stands for. Fitting a line to any range of steps is O(1).
class TraceSums {
  public:
    /// @param trace corners and ends of a chain; a closed one does not repeat its first point
    TraceSums(const std::vector<LatticePoint>& trace, bool closed, const CellShape& shape);

    [[nodiscard]] bool closed() const { return closed_; }
    [[nodiscard]] std::size_t steps() const { return steps_; }
    /// Lattice point at the beginning of a step. Steps of closed chains wrap around.
    [[nodiscard]] Vec2 at(std::size_t step) const { return points_[wrap(step)]; }
    /// Middle of a step.
    [[nodiscard]] Vec2 midpoint(std::size_t step) const { return 0.5 * (at(step) + at(step + 1)); }
    /// Returns the fine point nearest to a position.
    [[nodiscard]] FinePoint to_fine(Vec2 place) const { return shape_.to_fine(place, origin_); }
    [[nodiscard]] Vec2 from_fine(FinePoint point) const { return shape_.from_fine(point, origin_); }
    /// Length of the longest step.
    [[nodiscard]] double longest_step() const { return shape_.longer_side(); }
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
        Vec2 left;
        Vec2 right;
    };
    /// Cells on both sides of a step. A ring has its interior on the left.
    [[nodiscard]] Cells adjacent_cells(std::size_t step) const;
    /// Direction rotated by 90 degrees to the left. If rows run north, this is the right on the ground.
    [[nodiscard]] Vec2 left_of(Vec2 along) const {
        return mirrored() ? Vec2{along.y, -along.x} : Vec2{-along.y, along.x};
    }
    [[nodiscard]] bool mirrored() const { return cross(shape_.col, shape_.row) > 0; }

    struct Sums {
        double n = 0;
        Vec2 mean;
        double xx = 0;  ///< about the mean
        double xy = 0;
        double yy = 0;
        /// Sum of squared distances from the best line through the mean.
        [[nodiscard]] double least_squares() const {
            return std::max(0.0, (xx + yy - std::sqrt((xx - yy) * (xx - yy) + 4 * xy * xy)) / 2);
        }
        /// Direction with the smallest sum of squares.
        [[nodiscard]] Vec2 direction() const;
    };
    /// Sums over the midpoints of steps first .. last - 1; last <= first + steps() and < 2 * steps().
    [[nodiscard]] Sums sums(std::size_t first, std::size_t last) const;
    /// Returns true if the trace between two steps stays within `limit` of a line.
    [[nodiscard]] bool near(std::size_t first, std::size_t last, const Line2& line, double limit) const;

  private:
    using Moments = std::array<double, 5>;  // x, y, xx, xy, yy
    [[nodiscard]] std::size_t wrap(std::size_t step) const {
        while (closed_ && step >= steps_)
            step -= steps_;
        return step;
    }
    void add_edge(LatticePoint from, LatticePoint to);
    void accumulate();

    bool closed_;
    CellShape shape_;
    LatticePoint origin_;
    std::size_t steps_ = 0;
    std::vector<Vec2> points_;
    std::vector<std::uint32_t> corner_steps_;
    std::vector<std::uint32_t> corner_at_;  // index of the first corner at or after each step
    std::vector<Moments> prefix_sums_;      // prefix sums over the steps before each one
};

/// Steps at which a chain may turn: the vertices of its Douglas-Peucker simplification. Starts with 0; an
/// open chain ends with its last step. @param tolerance cells; staircases of straight walls stay whole above
/// 1
[[nodiscard]] std::vector<std::size_t> turning_points(const TraceSums& samples, double tolerance);

struct Circle {
    Vec2 centre;
    double radius = 0;

    [[nodiscard]] double offset(Vec2 p) const { return length(p - centre) - radius; }
    [[nodiscard]] Vec2 project(Vec2 p) const { return centre + radius / length(p - centre) * (p - centre); }
};

/// Fits a circle to the midpoints of steps first .. last - 1 by Taubin's algebraic fit; O(steps).
/// @return nullopt if they are collinear
[[nodiscard]] std::optional<Circle> fit_circle(const TraceSums& samples, std::size_t first, std::size_t last);

/// Circle through three points; nullopt if they are collinear.
[[nodiscard]] std::optional<Circle> circle_through(Vec2 a, Vec2 b, Vec2 c);

}  // namespace d2b::outline
