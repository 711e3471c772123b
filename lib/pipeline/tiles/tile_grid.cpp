#include "pipeline/tiles/tile_grid.hpp"

#include <algorithm>
#include <numeric>

namespace d2b {
namespace {

/// Returns the first unit that ends beyond a row or column. Binary search, because ends ascend.
template <typename EndOf>
std::int32_t first_beyond(std::int32_t place, std::int32_t count, const EndOf& end_of) {
    std::int32_t first = 0;
    while (first < count) {
        const std::int32_t middle = std::midpoint(first, count);
        if (end_of(middle) > place)
            count = middle;
        else
            first = middle + 1;
    }
    return first;
}

}  // namespace

TileGrid::TileGrid(const UnitGrid& units, std::int32_t side)
    : units_(units),
      side_(std::min(side, std::max(units.rows(), units.cols()))),
      rows_((units.rows() - 1) / side_ + 1),
      cols_((units.cols() - 1) / side_ + 1) {}

std::vector<PlacedUnit> TileGrid::units_of(std::int64_t tile) const {
    const auto first_row = static_cast<std::int32_t>(tile / cols_) * side_;
    const auto first_col = static_cast<std::int32_t>(tile % cols_) * side_;
    std::vector<PlacedUnit> all;
    for (std::int32_t row = first_row; row < std::min(first_row + side_, units_.rows()); ++row)
        for (std::int32_t col = first_col; col < std::min(first_col + side_, units_.cols()); ++col)
            all.push_back(unit(std::int64_t{row} * units_.cols() + col));
    return all;
}

std::int64_t TileGrid::tile_of(std::int64_t unit) const {
    return unit / units_.cols() / side_ * cols_ + unit % units_.cols() / side_;
}

PlacedUnit TileGrid::unit(std::int64_t number) const {
    return {number, units_.unit(static_cast<std::int32_t>(number / units_.cols()),
                                static_cast<std::int32_t>(number % units_.cols()))};
}

std::vector<PlacedUnit> TileGrid::units_in(const Window& window) const {
    const std::int32_t first_row = first_beyond(
        window.row, units_.rows(), [&](std::int32_t i) { return units_.unit(i, 0).own.end_row(); });
    const std::int32_t first_col = first_beyond(
        window.col, units_.cols(), [&](std::int32_t i) { return units_.unit(0, i).own.end_col(); });
    std::vector<PlacedUnit> all;
    for (std::int32_t row = first_row; row < units_.rows(); ++row) {
        for (std::int32_t col = first_col; col < units_.cols(); ++col) {
            all.push_back(unit(std::int64_t{row} * units_.cols() + col));
            if (all.back().unit.own.end_col() >= window.end_col())
                break;
        }
        if (all.back().unit.own.end_row() >= window.end_row())
            break;
    }
    return all;
}

Unit TileGrid::whole(std::int64_t tile) const {
    Unit all;
    for (const PlacedUnit& placed : units_of(tile))
        all = {around(all.own, placed.unit.own), around(all.seen, placed.unit.seen)};
    return all;
}

Window around(const Window& a, const Window& b) {
    if (a.points() == 0 || b.points() == 0)
        return a.points() == 0 ? b : a;
    const std::int32_t row = std::min(a.row, b.row);
    const std::int32_t col = std::min(a.col, b.col);
    return {row, col, std::max(a.end_row(), b.end_row()) - row, std::max(a.end_col(), b.end_col()) - col};
}

bool meet(const Window& a, const Window& b) {
    return a.row < b.end_row() && b.row < a.end_row() && a.col < b.end_col() && b.col < a.end_col();
}

Window grown(const Window& window, std::int32_t rows, std::int32_t cols, const Window& within) {
    const std::int32_t row = window.row - std::min(rows, window.row - within.row);
    const std::int32_t col = window.col - std::min(cols, window.col - within.col);
    return {row, col, window.end_row() + std::min(rows, within.end_row() - window.end_row()) - row,
            window.end_col() + std::min(cols, within.end_col() - window.end_col()) - col};
}

}  // namespace d2b
