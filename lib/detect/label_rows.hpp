#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/band.hpp"
#include "core/executor.hpp"
#include "core/grid.hpp"
#include "core/row_bands.hpp"
#include "dem2buildings/spool.hpp"
#include "detect/unit_grid.hpp"

namespace d2b {

/// Labels of a window, spooled to disk unit by unit as runs: 12 bytes per run and 4 bytes per row of a unit.
class LabelRows {
  public:
    LabelRows() = default;
    /// @param window extent of the labels
    LabelRows(std::unique_ptr<Spool> spool, const Window& window)
        : spool_(std::move(spool)), window_(window) {}

    /// Appends the core cells of the next unit. Units come row by row.
    /// @param labels labels of the unit's extent
    /// @param more offset added to labels other than 0
    void append(const Unit& unit, const Grid<Label>& labels, Executor& threads, Label more = 0);
    /// Relabels all units.
    /// @param number new label by old label
    void renumber(std::vector<Label> number) { number_ = std::move(number); }

    /// Reads the labels of a band of the window. Callable from any thread after the last append().
    /// @throws OutputError if the spool cannot be read
    [[nodiscard]] LabelBand band(const BandShape& shape) const;

  private:
    /// Run of cells in columns of the window.
    struct Run {
        std::int32_t begin;
        std::int32_t end;
        Label label;
    };
    /// Row of adjacent units.
    struct UnitRow {
        RowBand rows;                                ///< rows of the whole raster
        std::vector<std::vector<SpoolEntry>> units;  ///< spool entries per unit, one per slab of rows
    };
    void read_slab(const SpoolEntry& entry, RowBand rows, LabelBand& band) const;

    std::unique_ptr<Spool> spool_;
    Window window_;
    std::vector<UnitRow> unit_rows_;
    std::vector<Label> number_;
};

}  // namespace d2b
