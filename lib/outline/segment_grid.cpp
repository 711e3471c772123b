#include "outline/segment_grid.hpp"

namespace d2b::outline {

SegmentGrid::SegmentGrid(const Arcs& arcs, const LatticeBox& box, std::size_t edges)
    : arcs_(&arcs), low_(fine(box.low)), versions_(arcs.size(), 0) {
    const FinePoint high = fine(box.high);
    const auto buckets = [&] {
        rows_ = ((high.row - low_.row) >> shift_) + 1;
        cols_ = ((high.col - low_.col) >> shift_) + 1;
        return rows_ * cols_;
    };
    while (buckets() > 64 + 2 * static_cast<std::int64_t>(edges))
        ++shift_;
    heads_.assign(static_cast<std::size_t>(rows_ * cols_), none);
    entries_.reserve(edges + edges / 2);
}

void SegmentGrid::update(std::uint32_t arc) {
    ++versions_[arc];
    for (std::uint32_t i = 0; i + 1 < (*arcs_)[arc].size(); ++i) {
        const FineSegment edge = segment({arc, i});
        const Box box = box_of(edge);
        for_buckets(edge, [&](std::int64_t row, std::int64_t col) {
            std::uint32_t& head = heads_[slot(row, col)];
            entries_.push_back({box, {arc, i}, versions_[arc], head});
            head = static_cast<std::uint32_t>(entries_.size() - 1);
        });
    }
}

}  // namespace d2b::outline
