#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "outline/fine_geometry.hpp"

namespace d2b {

/// Edges of drawn arcs in buckets of 8 x 8 cells, to find those that are near each other.
class SegmentGrid {
  public:
    struct Edge {
        std::uint32_t arc;
        std::uint32_t index;  ///< of its first vertex
    };
    using Arcs = std::vector<std::vector<FinePoint>>;

    /// @param arcs must outlive this. O(n log n) in buckets that edges pass
    explicit SegmentGrid(const Arcs& arcs);

    [[nodiscard]] FineSegment segment(Edge e) const {
        return {(*arcs_)[e.arc][e.index], (*arcs_)[e.arc][e.index + 1]};
    }
    /// The edges of one bucket after the other: each pair of edges that meet is in one of them.
    template <typename Visit>
    void for_each_bucket(const Visit& visit) const {
        for (std::size_t i = 0; i < entries_.size();) {
            std::size_t end = i + 1;
            while (end < entries_.size() && entries_[end].bucket == entries_[i].bucket)
                ++end;
            visit(std::span(entries_).subspan(i, end - i));
            i = end;
        }
    }
    struct Entry {
        std::uint64_t bucket;
        Edge edge;
    };
    /// The edges of a bucket.
    [[nodiscard]] std::span<const Entry> at(std::int64_t bucket_row, std::int64_t bucket_col) const;
    [[nodiscard]] static std::int64_t bucket_of(std::int64_t coordinate) { return coordinate >> shift; }
    [[nodiscard]] static std::int64_t first_of(std::int64_t bucket) { return bucket * (1 << shift); }
    /// Columns of buckets in which there are edges.
    [[nodiscard]] std::int64_t first_col() const { return first_col_; }

  private:
    static constexpr int shift = 13;
    static std::uint64_t key(std::int64_t row, std::int64_t col) {
        return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32) |
               static_cast<std::uint32_t>(col);
    }
    void add(Edge edge);

    const Arcs* arcs_;
    std::vector<Entry> entries_;
    std::int64_t first_col_ = 0;
};

}  // namespace d2b
