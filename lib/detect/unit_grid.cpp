#include "detect/unit_grid.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {
namespace {

constexpr double fewest_around = 64;  // cells

std::int32_t cells_around(double around, double step, std::int32_t length) {
    return static_cast<std::int32_t>(std::clamp(
        std::ceil(around / step), std::min<double>(fewest_around, length), static_cast<double>(length)));
}

}  // namespace

UnitGrid::UnitGrid(const Window& window, const CellSize& cell, double around, const UnitSize& size)
    : down_{{window.row, window.rows}, 1, cells_around(around, cell.down, window.rows)},
      across_{{window.col, window.cols}, 1, cells_around(around, cell.across, window.cols)} {
    if (window.points() <= size.most_whole)
        return;
    for (Axis* axis : {&down_, &across_})
        axis->parts = (axis->window.length - 1) / size.most_side + 1;
}

Unit UnitGrid::unit(std::int32_t row, std::int32_t col) const {
    const auto window = [](const Stretch& rows, const Stretch& cols) {
        return Window{rows.first, cols.first, rows.length, cols.length};
    };
    return {window(down_.own(row), across_.own(col)), window(down_.seen(row), across_.seen(col))};
}

std::int64_t UnitGrid::most_seen() const {
    return std::int64_t{down_.most_seen()} * across_.most_seen();
}

UnitGrid::Stretch UnitGrid::Axis::own(std::int32_t part) const {
    const auto border = [this](std::int64_t i) {
        return static_cast<std::int32_t>(window.length * i / parts);
    };
    return {window.first + border(part), border(part + std::int64_t{1}) - border(part)};
}

UnitGrid::Stretch UnitGrid::Axis::seen(std::int32_t part) const {
    const Stretch middle = own(part);
    const std::int32_t before = std::min(around, middle.first - window.first);
    const std::int32_t behind =
        std::min(around, window.length - (middle.first - window.first) - middle.length);
    return {middle.first - before, before + middle.length + behind};
}

std::int32_t UnitGrid::Axis::most_seen() const {
    std::int32_t most = 0;
    for (std::int32_t part = 0; part < parts; ++part)
        most = std::max(most, seen(part).length);
    return most;
}

}  // namespace d2b
