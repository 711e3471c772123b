#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/band.hpp"

namespace d2b {

inline constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

/// A longest stretch of squares of one row that belong to one level (and, above level 0, to one label).
struct Run {
    std::int32_t begin = 0;  ///< column of its first square
    std::int32_t end = 0;    ///< one past its last
    Label label = 0;
    std::uint32_t below = no_index;  ///< the run one level down that contains it, in the same row
    std::uint32_t component = no_index;
    std::uint32_t head = no_index;  ///< arm of the outline that comes down its left side
    std::uint32_t tail = no_index;  ///< arm of the outline that goes up its right side
};

/// A longest run of squares with the same levels, down from the highest: what statistics are added by.
struct TopRun {
    std::int32_t begin = 0;
    std::int32_t end = 0;
    std::int32_t level = 0;             ///< the highest level that it belongs to
    std::uint32_t run = no_index;       ///< there
    std::uint32_t building = no_index;  ///< the run of level 1 that contains it
};

/// One row of squares, taken apart.
struct RunRow {
    std::vector<std::vector<Run>> levels;  ///< runs by level, ascending columns
    std::vector<TopRun> top_runs;

    void clear() {
        for (auto& runs : levels)
            runs.clear();
        top_runs.clear();
    }
};

/// Cuts a row into runs on all levels in one pass: where the count rises, runs open; where it falls, they
/// close.
/// @param labels one a square, or none: all are label 1
template <typename Count>
void cut_into_runs(std::span<const Count> counts, std::span<const Label> labels, RunRow& row) {
    row.clear();
    const auto cols = static_cast<std::int32_t>(counts.size());
    std::int32_t open = 0;  // runs are open on levels 0 .. open - 1
    Label label = 0;
    for (std::int32_t col = 0; col < cols;) {
        const auto at = static_cast<std::size_t>(col);
        const std::int32_t count = counts[at];
        const Label next_label = labels.empty() ? 1 : labels[at];
        const std::int32_t shared = std::min({open, count, next_label == label ? count : 1});
        while (open > shared)
            row.levels[static_cast<std::size_t>(--open)].back().end = col;
        for (; open < count; ++open) {
            const std::uint32_t below =
                open == 0
                    ? no_index
                    : static_cast<std::uint32_t>(row.levels[static_cast<std::size_t>(open - 1)].size() - 1);
            row.levels[static_cast<std::size_t>(open)].push_back(
                {col, cols, open == 0 ? 0 : next_label, below});
        }
        label = next_label;
        std::int32_t end = col + 1;
        while (end < cols && counts[static_cast<std::size_t>(end)] == counts[at] &&
               (labels.empty() || labels[static_cast<std::size_t>(end)] == label))
            ++end;
        if (count > 0) {
            const auto last = [&](std::int32_t level) {
                return static_cast<std::uint32_t>(row.levels[static_cast<std::size_t>(level)].size() - 1);
            };
            row.top_runs.push_back({col, end, count - 1, last(count - 1), count > 1 ? last(1) : no_index});
        }
        col = end;
    }
}

}  // namespace d2b
