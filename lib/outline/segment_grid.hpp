#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <vector>

#include "outline/fine_geometry.hpp"

namespace d2b::outline {

/// Uniform grid of the edges of drawn arcs for finding nearby edges. Arcs can be inserted and changed.
class SegmentGrid {
  public:
    struct Edge {
        std::uint32_t arc;
        std::uint32_t index;  ///< index of its first vertex
        friend auto operator<=>(const Edge&, const Edge&) = default;
    };
    using Arcs = std::vector<std::vector<FinePoint>>;

    /// @param arcs must outlive this @param box approximate extent; vertices outside are found as well
    /// @param edges approximate number
    SegmentGrid(const Arcs& arcs, const LatticeBox& box, std::size_t edges);

    /// Inserts or moves the edges of an arc.
    void update(std::uint32_t arc);

    [[nodiscard]] FineSegment segment(Edge e) const {
        return {(*arcs_)[e.arc][e.index], (*arcs_)[e.arc][e.index + 1]};
    }
    /// Calls visit(edge) for edges near a segment, including all that intersect it; may repeat edges.
    template <typename Visit>
    void near(const FineSegment& segment, const Visit& visit) const {
        const Box box = box_of(segment);
        for_buckets(segment, [&](std::int64_t row, std::int64_t col) {
            for (std::uint32_t i = heads_[slot(row, col)]; i != none; i = entries_[i].next)
                if (const Entry& entry = entries_[i];
                    entry.box.overlaps(box) && entry.version == versions_[entry.edge.arc])
                    visit(entry.edge);
        });
    }
    template <typename Visit>
    void visit_bucket(std::int64_t row, std::int64_t col, const Visit& visit) const {
        for (std::uint32_t i = heads_[slot(row, col)]; i != none; i = entries_[i].next)
            if (entries_[i].version == versions_[entries_[i].edge.arc])
                visit(entries_[i].edge);
    }
    /// Bucket of a coordinate, clamped to the grid.
    [[nodiscard]] std::int64_t row_of(std::int64_t row) const {
        return std::clamp((row - low_.row) >> shift_, std::int64_t{0}, rows_ - 1);
    }
    [[nodiscard]] std::int64_t col_of(std::int64_t col) const {
        return std::clamp((col - low_.col) >> shift_, std::int64_t{0}, cols_ - 1);
    }
    /// First coordinate of a column of buckets.
    [[nodiscard]] std::int64_t bucket_start(std::int64_t col) const { return low_.col + (col << shift_); }

  private:
    static constexpr std::uint32_t none = 0xffffffff;
    /// Bounds of an edge in 64ths of a cell relative to the grid, rounded down.
    struct Box {
        std::int32_t top;
        std::int32_t bottom;
        std::int32_t left;
        std::int32_t right;
        [[nodiscard]] bool overlaps(const Box& other) const {
            return top <= other.bottom && other.top <= bottom && left <= other.right && other.left <= right;
        }
    };
    struct Entry {
        Box box;
        Edge edge;
        std::uint32_t version;  // version of the arc at insertion
        std::uint32_t next;     // next entry of the bucket
    };
    [[nodiscard]] std::size_t slot(std::int64_t row, std::int64_t col) const {
        return static_cast<std::size_t>(row * cols_ + col);
    }
    [[nodiscard]] Box box_of(const FineSegment& s) const {
        const auto coarse = [](std::int64_t v) { return static_cast<std::int32_t>(v >> 4); };
        return {coarse(std::min(s.from.row, s.to.row) - low_.row),
                coarse(std::max(s.from.row, s.to.row) - low_.row),
                coarse(std::min(s.from.col, s.to.col) - low_.col),
                coarse(std::max(s.from.col, s.to.col) - low_.col)};
    }
    template <typename Visit>
    void for_buckets(const FineSegment& segment, const Visit& visit) const;

    const Arcs* arcs_;
    FinePoint low_;
    int shift_ = 12;  // buckets of 4 x 4 cells, larger if there would be too many
    std::int64_t rows_ = 0;
    std::int64_t cols_ = 0;
    std::vector<std::uint32_t> heads_;  // first entry of each bucket
    std::vector<Entry> entries_;
    std::vector<std::uint32_t> versions_;  // per arc
};

template <typename Visit>
void SegmentGrid::for_buckets(const FineSegment& segment, const Visit& visit) const {
    const bool down = segment.from.row < segment.to.row;
    const FinePoint& upper = down ? segment.from : segment.to;
    const FinePoint& lower = down ? segment.to : segment.from;
    const std::int64_t first_row = row_of(upper.row);
    const std::int64_t last_row = row_of(lower.row);
    const std::int64_t first_col = col_of(std::min(upper.col, lower.col));
    const std::int64_t last_col = col_of(std::max(upper.col, lower.col));
    if (last_row - first_row <= 1 || last_col - first_col <= 1) {
        for (std::int64_t row = first_row; row <= last_row; ++row)
            for (std::int64_t col = first_col; col <= last_col; ++col)
                visit(row, col);
        return;
    }
    const double slope =
        static_cast<double>(lower.col - upper.col) / static_cast<double>(lower.row - upper.row);
    const auto col_at = [&](std::int64_t row) {
        const std::int64_t border = std::clamp(low_.row + (row << shift_), upper.row, lower.row);
        return static_cast<double>(upper.col) + slope * static_cast<double>(border - upper.row);
    };
    for (std::int64_t row = first_row; row <= last_row; ++row) {
        // Columns between the upper and lower border of the bucket, with a margin for rounding. The last row
        // includes everything below it.
        double from = row > first_row ? col_at(row) : static_cast<double>(upper.col);
        double to = row < last_row ? col_at(row + 1) : static_cast<double>(lower.col);
        if (from > to)
            std::swap(from, to);
        const std::int64_t first = col_of(static_cast<std::int64_t>(std::floor(from)) - 1);
        const std::int64_t last = col_of(static_cast<std::int64_t>(std::ceil(to)) + 1);
        for (std::int64_t col = first; col <= last; ++col)
            visit(row, col);
    }
}

}  // namespace d2b::outline
