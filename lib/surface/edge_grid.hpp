#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/lattice.hpp"

namespace d2b {

/// Finds edges of a plan by their place, on a grid of two cells. An edge that has changed is put down again
/// where it runs now, and is still found where it ran before: callers look at the edges themselves. A long
/// edge costs its length, and not the area of its box.
class EdgeGrid {
  public:
    void add(std::uint32_t edge, FinePoint a, FinePoint b);

    /// Calls visit(edge) for all that may meet a box, in any order, some more than once, until it returns
    /// false.
    /// @return whether it never did
    template <typename Visit>
    bool all_in_box(FinePoint low, FinePoint high, const Visit& visit) const {
        for (std::int64_t row = cell(low.row - margin); row <= cell(high.row + margin); ++row)
            if (!all_in_row(row, cell(low.col - margin), cell(high.col + margin), visit))
                return false;
        return true;
    }
    /// The same of all that may meet a triangle; with b == c of a straight line.
    /// @param around steps by which it is larger
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
    using Range = std::pair<std::int64_t, std::int64_t>;  // of cells, both ends included
    struct CellHash {
        std::size_t operator()(const Range& cell) const {
            return static_cast<std::size_t>(cell.first * 1000003 + cell.second);
        }
    };
    [[nodiscard]] static std::int64_t cell(std::int64_t at) { return at >> 11; }
    /// Steps that are looked farther, because an edge may be divided at a place that lies hardly beside it
    /// and is not put down again.
    static constexpr std::int64_t margin = 2;
    [[nodiscard]] static Range rows_of(FinePoint a, FinePoint b, FinePoint c, std::int64_t more);
    /// The cells of a row that a triangle covers.
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
