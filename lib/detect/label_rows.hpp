#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/band.hpp"
#include "core/executor.hpp"
#include "core/grid.hpp"
#include "core/row_bands.hpp"
#include "dem2buildings/spool.hpp"

namespace d2b {

/// Calls use(begin, end, label) for each run of cells of a row with a label other than 0.
template <typename Use>
void for_label_runs(std::span<const Label> row, const Use& use) {
    for (std::size_t begin = 0; begin < row.size();) {
        const Label label = row[begin];
        std::size_t end = begin + 1;
        while (end < row.size() && row[end] == label)
            ++end;
        if (label != 0)
            use(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end), label);
        begin = end;
    }
}

/// The labels of a window, row by row, as runs that wait in a spool: 12 bytes a run.
class LabelRows {
  public:
    LabelRows() = default;
    explicit LabelRows(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// The next rows: these of a grid.
    void append(const Grid<Label>& labels, RowBand rows, Executor& threads);
    /// Gives other labels to all rows. @param number the new label, by the old one
    void renumber(std::vector<Label> number) { number_ = std::move(number); }
    /// From any thread, once all rows are there. @param row first, counted from the window's
    /// @param labels of whole rows @throws OutputError the spool cannot be read
    void read(std::int32_t row, std::int32_t cols, std::span<Label> labels) const;

    /// The labels of a band. @param window_row of the window in the whole raster
    [[nodiscard]] LabelBand band(const BandShape& shape, std::int32_t window_row) const;

  private:
    struct Run {
        std::int32_t begin;
        std::int32_t end;
        Label label;
    };
    std::unique_ptr<Spool> spool_;
    std::vector<SpoolEntry> rows_;
    std::vector<Label> number_;
};

}  // namespace d2b
