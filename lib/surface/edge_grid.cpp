#include "surface/edge_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace d2b {
namespace {

struct Cols {
    double low = 0;
    double high = 0;
};

/// Returns the columns of a segment between two rows.
std::optional<Cols> cols_between(FinePoint a, FinePoint b, double low_row, double high_row) {
    if (b.row < a.row)
        std::swap(a, b);
    const auto from = static_cast<double>(a.row);
    const auto to = static_cast<double>(b.row);
    if (to < low_row || from > high_row)
        return std::nullopt;
    const auto at = [&](double row) {
        const double share = to > from ? std::clamp((row - from) / (to - from), 0.0, 1.0) : 0.0;
        return static_cast<double>(a.col) + share * static_cast<double>(b.col - a.col);
    };
    const double first = at(low_row);
    const double last = to > from ? at(high_row) : static_cast<double>(b.col);
    return Cols{std::min(first, last), std::max(first, last)};
}

}  // namespace

EdgeGrid::Range EdgeGrid::rows_of(FinePoint a, FinePoint b, FinePoint c, std::int64_t more) {
    const auto [low, high] = std::minmax({a.row, b.row, c.row});
    return {cell(low - more), cell(high + more)};
}

std::optional<EdgeGrid::Range> EdgeGrid::cols_of(FinePoint a, FinePoint b, FinePoint c, std::int64_t row,
                                                 std::int64_t more) {
    const auto low_row = static_cast<double>((row << 11) - more);
    const auto high_row = static_cast<double>(((row + 1) << 11) + more);
    std::optional<Cols> all;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        if (const auto cols = cols_between(from, to, low_row, high_row))
            all = all ? Cols{std::min(all->low, cols->low), std::max(all->high, cols->high)} : *cols;
    if (!all)
        return std::nullopt;
    return Range{cell(static_cast<std::int64_t>(std::floor(all->low)) - more),
                 cell(static_cast<std::int64_t>(std::ceil(all->high)) + more)};
}

void EdgeGrid::add(std::uint32_t edge, FinePoint a, FinePoint b) {
    const auto [first, last] = rows_of(a, b, b, 0);
    for (std::int64_t row = first; row <= last; ++row)
        if (const auto cols = cols_of(a, b, b, row, 0))
            for (std::int64_t col = cols->first; col <= cols->second; ++col)
                cells_[{row, col}].push_back(edge);
}

}  // namespace d2b
