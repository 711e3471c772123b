#include "view/map_frame.hpp"

#include <algorithm>
#include <utility>

namespace d2b::view {

MapFrame::MapFrame(MapArea area, PixelSize size) : area_(std::move(area)), size_(size) {}

double MapFrame::metres_per_pixel() const {
    return area_.cell.across * area_.dem.window.cols / size_.width;
}

PixelPoint MapFrame::pixel(Position position) const {
    // Clamps far points, because Cairo's fixed-point coordinates have only 24 integer bits.
    constexpr double far = 1e6;
    const AffineTransform& g = area_.dem.transform;
    const Window& window = area_.dem.window;
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

std::optional<PixelPoint> MapFrame::north() const {
    const Crs::Kind kind = area_.crs.kind();
    if (kind != Crs::Kind::projected && kind != Crs::Kind::geographic)
        return std::nullopt;
    const AffineTransform& g = area_.dem.transform;
    const double determinant = g[1] * g[5] - g[2] * g[4];
    // Columns and rows of a step along y, in metres.
    const double across = -g[2] / determinant * area_.cell.across * (right_to_left() ? -1 : 1);
    const double down = g[1] / determinant * area_.cell.down * (bottom_up() ? -1 : 1);
    const double length = std::hypot(across, down);
    return PixelPoint{across / length, down / length};
}

int round_to_pixels(double length) {
    return std::max(1, static_cast<int>(std::lround(length)));
}

double aspect_ratio(const MapArea& area) {
    return area.cell.across * area.dem.window.cols / (area.cell.down * area.dem.window.rows);
}

}  // namespace d2b::view
