#include "preview/map_frame.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace d2b {

MapFrame::MapFrame(MapGround ground, PixelSize size) : ground_(std::move(ground)), size_(size) {}

double MapFrame::metres_per_pixel() const {
    return ground_.cell.across * ground_.dem.window.cols / size_.width;
}

Spot MapFrame::spot(Position position) const {
    // Clamps far points, because Cairo's fixed-point coordinates have only 24 integer bits.
    constexpr double far = 1e6;
    const AffineTransform& g = ground_.dem.transform;
    const Window& window = ground_.dem.window;
    const double dx = position.x - g[0];
    const double dy = position.y - g[3];
    const double determinant = g[1] * g[5] - g[2] * g[4];
    const double col = (dx * g[5] - dy * g[2]) / determinant;
    const double row = (dy * g[1] - dx * g[4]) / determinant;
    const double x = (col - window.col) * size_.width / window.cols;
    const double y = (row - window.row) * size_.height / window.rows;
    return {std::clamp(right_to_left() ? size_.width - x : x, -far, far),
            std::clamp(bottom_up() ? size_.height - y : y, -far, far)};
}

std::optional<Spot> MapFrame::north() const {
    const Crs::Kind kind = ground_.crs.kind();
    if (kind != Crs::Kind::projected && kind != Crs::Kind::geographic)
        return std::nullopt;
    const AffineTransform& g = ground_.dem.transform;
    const double determinant = g[1] * g[5] - g[2] * g[4];
    // Columns and rows of a step along y, in metres.
    const double across = -g[2] / determinant * ground_.cell.across * (right_to_left() ? -1 : 1);
    const double down = g[1] / determinant * ground_.cell.down * (bottom_up() ? -1 : 1);
    const double length = std::hypot(across, down);
    return Spot{across / length, down / length};
}

int whole_pixels(double length) {
    return std::max(1, static_cast<int>(std::lround(length)));
}

double aspect_of(const MapGround& ground) {
    return ground.cell.across * ground.dem.window.cols / (ground.cell.down * ground.dem.window.rows);
}

}  // namespace d2b
