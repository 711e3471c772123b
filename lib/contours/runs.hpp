#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/band.hpp"

namespace d2b::contours {

inline constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

/// A maximal run of squares of one row that belong to one level (and, above level 0, to one label).
struct Run {
    std::int32_t begin = 0;  ///< first column
    std::int32_t end = 0;    ///< one past the last column
    Label label = 0;
    std::uint32_t below = no_index;  ///< index of the containing run one level down, in the same row
    std::uint32_t component = no_index;
    std::uint32_t head = no_index;  ///< end of the outline that runs down its left side
    std::uint32_t tail = no_index;  ///< end of the outline that runs up its right side
};

/// A maximal run of squares with the same highest level; the unit for adding statistics.
struct TopRun {
    std::int32_t begin = 0;
    std::int32_t end = 0;
    std::int32_t level = 0;             ///< highest level of the squares
    std::uint32_t run = no_index;       ///< index of the run of that level
    std::uint32_t building = no_index;  ///< index of the containing run of level 1
};

/// Run-length encoding of a row of squares on all levels.
struct RunRow {
    std::vector<std::vector<Run>> levels;  ///< runs per level, ascending columns
    std::vector<TopRun> top_runs;

    void clear() {
        for (auto& runs : levels)
            runs.clear();
        top_runs.clear();
    }
};

/// Builds the runs of all levels in one pass from left to right: runs open where levels rise and close where
/// they fall.
class RunEncoder {
  public:
    /// @param row with one list per level; cleared
    explicit RunEncoder(RunRow& row) : row_(row) { row.clear(); }

    /// Adds consecutive squares with the same levels and label. Squares in gaps belong to no level. @param
    /// count number of levels, positive
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
    /// Call after the last stretch.
    void finish() { close(0, end_); }

  private:
    [[nodiscard]] std::vector<Run>& runs(std::int32_t level) {
        return row_.levels[static_cast<std::size_t>(level)];
    }
    [[nodiscard]] std::uint32_t last(std::int32_t level) {
        return static_cast<std::uint32_t>(runs(level).size() - 1);
    }
    /// Closes the runs of level `from` and above.
    void close(std::int32_t from, std::int32_t col) {
        while (open_ > from)
            runs(--open_).back().end = col;
    }

    RunRow& row_;
    std::int32_t open_ = 0;  ///< number of levels with open runs
    std::int32_t end_ = 0;   ///< end of the last stretch
    Label label_ = 0;        ///< label of the last stretch
};

/// Run-length encodes a row. @param labels one per square, or empty: label 1 everywhere
template <typename Count>
void run_length_encode(std::span<const Count> counts, std::span<const Label> labels, RunRow& row) {
    RunEncoder encoder(row);
    for (std::size_t col = 0; col < counts.size();) {
        std::size_t end = col + 1;
        while (end < counts.size() && counts[end] == counts[col] &&
               (labels.empty() || labels[end] == labels[col]))
            ++end;
        if (counts[col] > 0)
            encoder.add(static_cast<std::int32_t>(col), static_cast<std::int32_t>(end), counts[col],
                        labels.empty() ? 1 : labels[col]);
        col = end;
    }
    encoder.finish();
}

}  // namespace d2b::contours
