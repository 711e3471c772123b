#include "compare/height_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/box_tree.hpp"

namespace d2b::compare {

HeightGrid::HeightGrid(std::int32_t rows, std::int32_t cols, const AffineTransform& transform)
    : rows_(rows),
      cols_(cols),
      transform_(transform),
      determinant_(transform[1] * transform[5] - transform[2] * transform[4]),
      centimetres_(static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols), unknown) {}

void HeightGrid::set(const Window& part, std::span<const float> heights_m) {
    constexpr double per_metre = 100;
    std::size_t i = 0;
    for (std::int32_t row = part.row; row < part.end_row(); ++row)
        for (std::int32_t col = part.col; col < part.end_col(); ++col) {
            const auto height = static_cast<double>(heights_m[i++]);
            if (std::isnan(height))
                continue;
            const double rounded = std::clamp(std::round(height * per_metre), 0.0, unknown - 1.0);
            centimetres_[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
                         static_cast<std::size_t>(col)] = static_cast<std::uint16_t>(rounded);
        }
}

double HeightGrid::at(const Position& position) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const double dx = position.x - transform_[0];
    const double dy = position.y - transform_[3];
    const double col = std::floor((dx * transform_[5] - dy * transform_[2]) / determinant_);
    const double row = std::floor((dy * transform_[1] - dx * transform_[4]) / determinant_);
    if (!(row >= 0 && row < rows_ && col >= 0 && col < cols_))
        return nan;
    const std::uint16_t height =
        centimetres_[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
                     static_cast<std::size_t>(col)];
    return height == unknown ? nan : height / 100.0;
}

std::vector<double> SurveyHeights::at(std::span<const Position> positions) const {
    std::vector<Position> places(positions.begin(), positions.end());
    for (Position& p : places)
        p = {p.x - offset.x, p.y - offset.y};
    if (to_grid)
        to_grid(places);
    std::vector<double> heights;
    heights.reserve(places.size());
    for (const Position& p : places)
        heights.push_back(grid.at(p));
    return heights;
}

namespace {

void add_crossings(const WorldRing& ring, double y, std::vector<double>& crossings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& a = ring[i];
        const Position& b = ring[(i + 1) % ring.size()];
        if ((a.y > y) != (b.y > y))
            crossings.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
    }
}

}  // namespace

std::vector<Position> positions_in(const Polygons& outline, double step) {
    const Box box = box_of(outline);
    std::vector<Position> positions;
    // Lines are counted, because sums of steps would differ from outline to outline.
    const auto line = [step](std::int64_t number) { return (static_cast<double>(number) + 0.5) * step; };
    for (auto row = static_cast<std::int64_t>(std::floor(box.low / step)); line(row) < box.high; ++row) {
        const double y = line(row);
        std::vector<double> crossings;
        for (const WorldPolygon& polygon : outline) {
            add_crossings(polygon.exterior, y, crossings);
            for (const WorldRing& interior : polygon.interiors)
                add_crossings(interior, y, crossings);
        }
        std::ranges::sort(crossings);
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
            for (auto col = static_cast<std::int64_t>(std::ceil(crossings[i] / step - 0.5));
                 line(col) < crossings[i + 1]; ++col)
                positions.push_back({line(col), y});
    }
    return positions;
}

}  // namespace d2b::compare
