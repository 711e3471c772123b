#pragma once

#include <cmath>
#include <cstdint>

#include "core/grid.hpp"

namespace d2b {

/// Least-squares plane of the cells of a region.
struct Plane {
    double row = 0;  ///< a point of it, in rows and columns
    double col = 0;
    double z = 0;
    double down = 0;    ///< rise in m/m from row to row
    double across = 0;  ///< rise in m/m from column to column

    [[nodiscard]] double at(std::int32_t r, std::int32_t c, const CellSize& cell) const {
        return z + down * (r - row) * cell.down + across * (c - col) * cell.across;
    }
};

/// Sums over the cells of a region, from which the tilt of its least-squares plane follows. They are relative
/// to the first cell, because small numbers keep their digits.
class PlaneSums {
  public:
    void add(std::int32_t row, std::int32_t col, float z, const CellSize& cell) {
        if (n_ == 0) {
            row_ = row;
            col_ = col;
            z_ = z;
        }
        const double x = (col - col_) * cell.across;
        const double y = (row - row_) * cell.down;
        const auto h = static_cast<double>(z - z_);
        n_ += 1;
        sum_x_ += x;
        sum_y_ += y;
        sum_h_ += h;
        sum_xx_ += x * x;
        sum_xy_ += x * y;
        sum_yy_ += y * y;
        sum_xh_ += x * h;
        sum_yh_ += y * h;
    }
    [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(n_); }
    /// Returns the rise of the plane in m/m along its steepest direction; 0 for collinear cells.
    /// @pre count() > 0
    [[nodiscard]] double tilt() const {
        const Slopes slopes = solve();
        return std::hypot(slopes.across, slopes.down) / slopes.determinant;
    }
    /// Returns the plane; level across collinear cells.
    /// @pre count() > 0
    [[nodiscard]] Plane plane(const CellSize& cell) const {
        const Slopes slopes = solve();
        return {row_ + sum_y_ / n_ / cell.down, col_ + sum_x_ / n_ / cell.across,
                static_cast<double>(z_) + sum_h_ / n_, slopes.down / slopes.determinant,
                slopes.across / slopes.determinant};
    }

  private:
    /// Slopes times the determinant.
    struct Slopes {
        double across;
        double down;
        double determinant;
    };
    [[nodiscard]] Slopes solve() const {
        const double xx = sum_xx_ / n_ - sum_x_ * sum_x_ / n_ / n_;
        const double xy = sum_xy_ / n_ - sum_x_ * sum_y_ / n_ / n_;
        const double yy = sum_yy_ / n_ - sum_y_ * sum_y_ / n_ / n_;
        const double xh = sum_xh_ / n_ - sum_x_ * sum_h_ / n_ / n_;
        const double yh = sum_yh_ / n_ - sum_y_ * sum_h_ / n_ / n_;
        // Collinear cells have no unique plane; the small number keeps it level across.
        return {xh * yy - yh * xy, yh * xx - xh * xy, xx * yy - xy * xy + 1e-6};
    }

    std::int32_t row_ = 0;
    std::int32_t col_ = 0;
    float z_ = 0;
    double n_ = 0;
    double sum_x_ = 0;
    double sum_y_ = 0;
    double sum_h_ = 0;
    double sum_xx_ = 0;
    double sum_xy_ = 0;
    double sum_yy_ = 0;
    double sum_xh_ = 0;
    double sum_yh_ = 0;
};

}  // namespace d2b
