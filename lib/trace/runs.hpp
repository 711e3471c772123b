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

/// Makes runs on all levels of stretches of squares, in one pass from left to right: where their levels rise,
/// runs open; where they fall, runs close.
class RunCutter {
  public:
    /// @param row with as many levels as there are; emptied
    explicit RunCutter(RunRow& row) : row_(row) { row.clear(); }

    /// A stretch of squares of one label that belong to the same levels. Squares between stretches belong to
    /// none. @param count of levels, more than 0
    void add(std::int32_t begin, std::int32_t end, std::int32_t count, Label label) {
        if (begin > end_)
            finish();
        close(std::min({open_, count, label == label_ ? count : 1}), begin);
        for (; open_ < count; ++open_)
            runs(open_).push_back(
                {begin, end, open_ == 0 ? 0 : label, open_ == 0 ? no_index : last(open_ - 1)});
        label_ = label;
        end_ = end;
        row_.top_runs.push_back({begin, end, count - 1, last(count - 1), count > 1 ? last(1) : no_index});
    }
    /// After the last stretch.
    void finish() { close(0, end_); }

  private:
    [[nodiscard]] std::vector<Run>& runs(std::int32_t level) {
        return row_.levels[static_cast<std::size_t>(level)];
    }
    [[nodiscard]] std::uint32_t last(std::int32_t level) {
        return static_cast<std::uint32_t>(runs(level).size() - 1);
    }
    /// Ends the runs on levels from this one on.
    void close(std::int32_t from, std::int32_t col) {
        while (open_ > from)
            runs(--open_).back().end = col;
    }

    RunRow& row_;
    std::int32_t open_ = 0;  ///< runs are open on levels below
    std::int32_t end_ = 0;   ///< of the last stretch
    Label label_ = 0;        ///< likewise
};

/// Cuts a row into runs. @param labels one a square, or none: all are label 1
template <typename Count>
void cut_into_runs(std::span<const Count> counts, std::span<const Label> labels, RunRow& row) {
    RunCutter cutter(row);
    for (std::size_t col = 0; col < counts.size();) {
        std::size_t end = col + 1;
        while (end < counts.size() && counts[end] == counts[col] &&
               (labels.empty() || labels[end] == labels[col]))
            ++end;
        if (counts[col] > 0)
            cutter.add(static_cast<std::int32_t>(col), static_cast<std::int32_t>(end), counts[col],
                       labels.empty() ? 1 : labels[col]);
        col = end;
    }
    cutter.finish();
}

}  // namespace d2b
