#include "raster/row_spans.hpp"

#include <compare>
#include <cstddef>

#include "core/for_rings.hpp"

namespace d2b {
namespace {

constexpr std::int64_t whole_cell = FinePoint::steps;
constexpr std::int64_t half_cell = FinePoint::steps / 2;

/// Crossing of a ring with the centre line of a row.
struct Crossing {
    std::int64_t row;
    double col;  ///< fine steps

    friend auto operator<=>(const Crossing&, const Crossing&) = default;
};

/// Returns the first row with its centre line at or below this height.
std::int64_t row_from(std::int64_t fine_row) {
    const std::int64_t to_middle = fine_row - half_cell;
    return to_middle / whole_cell + (to_middle % whole_cell > 0 ? 1 : 0);
}

void cross_rows(const FineRing& ring, std::vector<Crossing>& crossings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const FinePoint& a = ring[i];
        const FinePoint& b = ring[i + 1 < ring.size() ? i + 1 : 0];
        const auto down = static_cast<double>(b.row - a.row);
        const auto across = static_cast<double>(b.col - a.col);
        const std::int64_t end = row_from(std::max(a.row, b.row));
        for (std::int64_t row = row_from(std::min(a.row, b.row)); row < end; ++row) {
            const auto to_middle = static_cast<double>(row * whole_cell + half_cell - a.row);
            crossings.push_back({row, static_cast<double>(a.col) + across * to_middle / down});
        }
    }
}

/// Returns the first column with its centre here or further right.
std::int32_t column_from(double fine_col) {
    return static_cast<std::int32_t>(std::ceil((fine_col - half_cell) / whole_cell));
}

}  // namespace

std::vector<RowSpan> row_spans(const FinePolygon& polygon) {
    std::vector<Crossing> crossings;
    for_rings(polygon, [&](const FineRing& ring) { cross_rows(ring, crossings); });
    std::ranges::sort(crossings);
    std::vector<RowSpan> spans;
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const RowSpan span{static_cast<std::int32_t>(crossings[i].row), column_from(crossings[i].col),
                           column_from(crossings[i + 1].col)};
        if (span.begin < span.end)
            spans.push_back(span);
    }
    return spans;
}

std::vector<RowSpan> row_spans(std::span<const WorldRing> rings, const Window& window) {
    const IndexRange rows{window.row, window.end_row()};
    const IndexRange cols{window.col, window.end_col()};
    std::vector<std::pair<std::int32_t, std::int32_t>> crossings;  // row, and first cell right of an edge
    for (const WorldRing& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Position& a = ring[i];
            const Position& b = ring[i + 1 < ring.size() ? i + 1 : 0];
            for_each_crossing({a.y, a.x}, {b.y, b.x}, rows, [&](std::int32_t row, double col) {
                crossings.emplace_back(row, first_centre(col, cols));
            });
        }
    std::ranges::sort(crossings);
    std::vector<RowSpan> spans;
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const RowSpan span{crossings[i].first, crossings[i].second, crossings[i + 1].second};
        if (span.begin < span.end)
            spans.push_back(span);
    }
    return spans;
}

}  // namespace d2b
