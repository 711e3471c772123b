#include "outline/segment_grid.hpp"

#include <cmath>
#include <tuple>

namespace d2b {

SegmentGrid::SegmentGrid(const Arcs& arcs) : arcs_(&arcs) {
    for (std::uint32_t arc = 0; arc < arcs.size(); ++arc)
        for (std::uint32_t i = 0; i + 1 < arcs[arc].size(); ++i)
            add({arc, i});
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return std::tie(a.bucket, a.edge.arc, a.edge.index) < std::tie(b.bucket, b.edge.arc, b.edge.index);
    });
}

void SegmentGrid::add(Edge edge) {
    const auto [a, b] = segment(edge);
    const FinePoint& upper = a.row < b.row ? a : b;
    const FinePoint& lower = a.row < b.row ? b : a;
    const auto rows = static_cast<double>(lower.row - upper.row);
    const auto cols = static_cast<double>(lower.col - upper.col);
    for (std::int64_t row = bucket_of(upper.row); row <= bucket_of(lower.row); ++row) {
        // Columns between the bucket's upper and lower border; a little more where doubles round.
        const auto col_at = [&](std::int64_t at) {
            const double share = rows > 0 ? static_cast<double>(at - upper.row) / rows : 0;
            return static_cast<double>(upper.col) + std::clamp(share, 0.0, 1.0) * cols;
        };
        double from = col_at(row << shift);
        double to = rows > 0 ? col_at((row + 1) << shift) : static_cast<double>(lower.col);
        if (from > to)
            std::swap(from, to);
        const std::int64_t first = bucket_of(static_cast<std::int64_t>(std::floor(from)) - 1);
        const std::int64_t last = bucket_of(static_cast<std::int64_t>(std::ceil(to)) + 1);
        first_col_ = std::min(first_col_, first);
        for (std::int64_t col = first; col <= last; ++col)
            entries_.push_back({key(row, col), edge});
    }
}

std::span<const SegmentGrid::Entry> SegmentGrid::at(std::int64_t bucket_row, std::int64_t bucket_col) const {
    const auto [first, last] =
        std::equal_range(entries_.begin(), entries_.end(), Entry{key(bucket_row, bucket_col), {}},
                         [](const Entry& a, const Entry& b) { return a.bucket < b.bucket; });
    return {first, last};
}

}  // namespace d2b
