#include "preview/map_frame.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {
namespace {

int pixels(double share, int longest) {
    return std::max(1, static_cast<int>(std::lround(share * longest)));
}

}  // namespace

MapFrame::MapFrame(const DemInfo& dem, int longest) : dem_(dem) {
    const AffineTransform& g = dem.transform;
    const double across = std::hypot(g[1], g[4]) * dem.window.cols;
    const double down = std::hypot(g[2], g[5]) * dem.window.rows;
    width_ = pixels(across / std::max(across, down), longest);
    height_ = pixels(down / std::max(across, down), longest);
}

Spot MapFrame::spot(Position position) const {
    const AffineTransform& g = dem_.transform;
    const double dx = position.x - g[0];
    const double dy = position.y - g[3];
    const double determinant = g[1] * g[5] - g[2] * g[4];
    const double col = (dx * g[5] - dy * g[2]) / determinant;
    const double row = (dy * g[1] - dx * g[4]) / determinant;
    const double x = (col - dem_.window.col) * width_ / dem_.window.cols;
    const double y = (row - dem_.window.row) * height_ / dem_.window.rows;
    return {right_to_left() ? width_ - x : x, bottom_up() ? height_ - y : y};
}

}  // namespace d2b
