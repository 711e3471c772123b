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

/// The labels of a window, unit by unit, as runs that wait in a spool: 12 bytes a run and 4 a row of a unit.
class LabelRows {
  public:
    LabelRows() = default;
    /// @param window what labels are of
    LabelRows(std::unique_ptr<Spool> spool, const Window& window)
        : spool_(std::move(spool)), window_(window) {}

    /// The own cells of the next unit. Units come row by row. @param labels of what the unit sees
    /// @param more is added to those other than 0
    void append(const Unit& unit, const Grid<Label>& labels, Executor& threads, Label more = 0);
    /// Gives other labels to all units. @param number the new label, by the old one
    void renumber(std::vector<Label> number) { number_ = std::move(number); }

    /// The labels of a band of the window. From any thread, once all units are there.
    /// @throws OutputError the spool cannot be read
    [[nodiscard]] LabelBand band(const BandShape& shape) const;

  private:
    /// Cells of the window.
    struct Run {
        std::int32_t begin;
        std::int32_t end;
        Label label;
    };
    /// The rows of the units that lie side by side.
    struct UnitRow {
        RowBand rows;                                ///< of the whole raster
        std::vector<std::vector<SpoolEntry>> units;  ///< each by slabs of rows
    };
    void read_slab(const SpoolEntry& entry, RowBand rows, LabelBand& band) const;

    std::unique_ptr<Spool> spool_;
    Window window_;
    std::vector<UnitRow> unit_rows_;
    std::vector<Label> number_;
};

}  // namespace d2b
