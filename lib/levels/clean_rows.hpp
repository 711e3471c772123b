#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "core/band.hpp"
#include "core/byte_record.hpp"
#include "core/row_slabs.hpp"
#include "dem2buildings/spool.hpp"
#include "levels/building_cells.hpp"

namespace d2b {

/// Clean elevations of buildings' cells, which wait in a spool as runs of constant elevation: 24 bytes a run.
class CleanRows {
  public:
    /// @param first_row of the window @param rows of it
    CleanRows(std::unique_ptr<Spool> spool, std::int32_t first_row, std::int32_t rows);

    /// A building's cells; each cell is given once. From any thread. @throws OutputError the spool has no
    /// room
    void add(const BuildingCells& cells);

    /// Cells of one building side by side with the same clean elevation; NaN where they are not valid.
    struct CleanRun {
        std::int32_t row;    ///< of the band
        std::int32_t begin;  ///< columns
        std::int32_t end;
        double elevation;
    };
    /// Calls use(run) for all cells of a band that were given, in no order. From any thread, once all are
    /// there. @throws OutputError the spool cannot be read
    template <typename Use>
    void for_runs(const BandShape& band, const Use& use) const {
        slabs_.for_band(band, [&](const std::vector<SpoolEntry>& entries) {
            for (const SpoolEntry& entry : entries) {
                ByteReader reader(*spool_, entry);
                for (std::size_t i = 0; i < entry.size / sizeof(Run); ++i) {
                    const Run run = reader.take<Run>();
                    if (run.row >= band.first_row && run.row < band.first_row + band.rows)
                        use(CleanRun{run.row - band.first_row, run.begin, run.end, run.elevation});
                }
            }
        });
    }

  private:
    struct Run {
        std::int32_t row;
        std::int32_t begin;
        std::int32_t end;
        std::int32_t unused = 0;
        double elevation;
    };

    std::unique_ptr<Spool> spool_;
    std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();  ///< of the slabs
    RowSlabs<std::vector<SpoolEntry>> slabs_;                             ///< the entries with runs in each
};

}  // namespace d2b
