#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/band.hpp"
#include "core/row_slabs.hpp"
#include "dem2buildings/spool.hpp"
#include "levels/building_cells.hpp"

namespace d2b {

/// Clean elevations of buildings' cells, which wait in a spool as runs of constant elevation: 24 bytes a run.
class CleanRows {
  public:
    /// @param first_row of the window @param rows of it
    CleanRows(std::unique_ptr<Spool> spool, std::int32_t first_row, std::int32_t rows);

    /// A building's cells; each cell is given once. @throws OutputError the spool has no room
    void add(const BuildingCells& cells);
    /// Elevations, clean in all cells that were given. From any thread, once all are there.
    /// @throws OutputError the spool cannot be read
    [[nodiscard]] ElevationBand clean(const ElevationBand& band) const;

  private:
    struct Run {
        std::int32_t row;
        std::int32_t begin;
        std::int32_t end;
        std::int32_t unused = 0;
        double elevation;
    };

    std::unique_ptr<Spool> spool_;
    RowSlabs<std::vector<SpoolEntry>> slabs_;  ///< the entries with runs in each
};

}  // namespace d2b
