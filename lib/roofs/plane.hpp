#pragma once

#include <algorithm>

namespace d2b::roofs {

/// Plane over the cells of a building: the elevation in metres at a position in cells.
struct Plane {
    double slope_x = 0;  ///< metres per cell
    double slope_y = 0;
    double z0 = 0;

    [[nodiscard]] double at(double x, double y) const { return slope_x * x + slope_y * y + z0; }
};

/// Weighted moments of points, from which the plane with the least squared error follows. Positions are
/// relative to the centre of a building, because sums of squares of large numbers lose digits.
class PlaneMoments {
  public:
    void add(double x, double y, double z, double weight = 1) {
        n_ += weight;
        x_ += weight * x;
        y_ += weight * y;
        z_ += weight * z;
        xx_ += weight * x * x;
        xy_ += weight * x * y;
        yy_ += weight * y * y;
        xz_ += weight * x * z;
        yz_ += weight * y * z;
        zz_ += weight * z * z;
    }
    void add(const PlaneMoments& other, double weight = 1) {
        n_ += weight * other.n_;
        x_ += weight * other.x_;
        y_ += weight * other.y_;
        z_ += weight * other.z_;
        xx_ += weight * other.xx_;
        xy_ += weight * other.xy_;
        yy_ += weight * other.yy_;
        xz_ += weight * other.xz_;
        yz_ += weight * other.yz_;
        zz_ += weight * other.zz_;
    }
    [[nodiscard]] double weight() const { return n_; }
    /// Best plane; level if there is no weight.
    [[nodiscard]] Plane fit() const {
        if (n_ <= 0)
            return {};
        const Centred c = centred();
        const auto [slope_x, slope_y] = slopes(c);
        return {slope_x, slope_y, (z_ - slope_x * x_ - slope_y * y_) / n_};
    }
    /// Weighted squared distance of the points from the best plane.
    [[nodiscard]] double error() const {
        if (n_ <= 0)
            return 0;
        const Centred c = centred();
        const auto [slope_x, slope_y] = slopes(c);
        return std::max(0.0, c.zz - slope_x * c.xz - slope_y * c.yz);
    }

  private:
    /// Weight of a slope of 0, which decides about the slope of a few points in a line.
    static constexpr double level_prior = 0.01;

    struct Centred {
        double xx, xy, yy, xz, yz, zz;
    };
    struct Slopes {
        double x, y;
    };
    [[nodiscard]] Centred centred() const {
        return {xx_ - x_ * x_ / n_ + level_prior,
                xy_ - x_ * y_ / n_,
                yy_ - y_ * y_ / n_ + level_prior,
                xz_ - x_ * z_ / n_,
                yz_ - y_ * z_ / n_,
                zz_ - z_ * z_ / n_};
    }
    [[nodiscard]] static Slopes slopes(const Centred& c) {
        const double determinant = c.xx * c.yy - c.xy * c.xy;
        if (!(determinant > 1e-12))
            return {0, 0};
        return {(c.xz * c.yy - c.yz * c.xy) / determinant, (c.yz * c.xx - c.xz * c.xy) / determinant};
    }

    double n_ = 0, x_ = 0, y_ = 0, z_ = 0;
    double xx_ = 0, xy_ = 0, yy_ = 0, xz_ = 0, yz_ = 0, zz_ = 0;
};

}  // namespace d2b::roofs
