#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/lattice.hpp"

namespace d2b {

/// Uniform grid index of the edges of a plan, with buckets of 2 x 2 cells. Modified edges are added again and
/// stay in their old buckets, so callers must test the edges themselves. A long edge costs its length, not
/// the area of its box.
class EdgeGrid {
  public:
    void add(std::uint32_t edge, FinePoint a, FinePoint b);

    /// Calls visit(edge) for all edges that may meet a box, in any order and possibly repeatedly, until it
    /// returns false. @return true if it never returned false
    template <typename Visit>
    bool all_in_box(FinePoint low, FinePoint high, const Visit& visit) const {
        for (std::int64_t row = cell(low.row - margin); row <= cell(high.row + margin); ++row)
            if (!all_in_row(row, cell(low.col - margin), cell(high.col + margin), visit))
                return false;
        return true;
    }
    /// Same for edges that may meet a triangle, or a segment if b == c. @param around distance in steps by
    /// which the triangle is enlarged
    template <typename Visit>
    bool all_in_triangle(FinePoint a, FinePoint b, FinePoint c, const Visit& visit,
                         std::int64_t around = 0) const {
        const auto [first, last] = rows_of(a, b, c, around + margin);
        for (std::int64_t row = first; row <= last; ++row)
            if (const auto cols = cols_of(a, b, c, row, around + margin))
                if (!all_in_row(row, cols->first, cols->second, visit))
                    return false;
        return true;
    }

  private:
    using Range =
        std::pair<std::int64_t, std::int64_t>;  // range of buckets, inclusive; also a bucket's row and column
    struct CellHash {
        std::size_t operator()(const Range& cell) const {
            return static_cast<std::size_t>(cell.first * 1000003 + cell.second);
        }
    };
    [[nodiscard]] static std::int64_t cell(std::int64_t at) { return at >> 11; }
    /// Margin of queries in steps, because a split may move an edge slightly without adding it again.
    static constexpr std::int64_t margin = 2;
    [[nodiscard]] static Range rows_of(FinePoint a, FinePoint b, FinePoint c, std::int64_t more);
    /// Returns the buckets of a row that a triangle covers.
    [[nodiscard]] static std::optional<Range> cols_of(FinePoint a, FinePoint b, FinePoint c, std::int64_t row,
                                                      std::int64_t more);

    template <typename Visit>
    bool all_in_row(std::int64_t row, std::int64_t first, std::int64_t last, const Visit& visit) const {
        for (std::int64_t col = first; col <= last; ++col)
            if (const auto found = cells_.find({row, col}); found != cells_.end())
                for (const std::uint32_t edge : found->second)
                    if (!visit(edge))
                        return false;
        return true;
    }

    std::unordered_map<Range, std::vector<std::uint32_t>, CellHash> cells_;
};

}  // namespace d2b
