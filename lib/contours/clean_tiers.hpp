#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "contours/merge_regions.hpp"
#include "core/band.hpp"
#include "core/byte_stream.hpp"
#include "core/context.hpp"
#include "core/grid.hpp"
#include "dem2buildings/spool.hpp"
#include "detect/units.hpp"
#include "elevations/elevation_reader.hpp"

namespace d2b::contours {

/// Clean elevations of buildings, spooled to disk as runs of constant elevation: 24 bytes per run.
class CleanRows {
  public:
    CleanRows(std::unique_ptr<Spool> spool, const Window& window);

    /// Adds the cells of a building; each cell is added once. Thread-safe.
    /// @throws OutputError if the spool has no space
    void add(const BuildingCells& cells);

    /// Run of cells of one building with the same clean elevation; NaN if not valid.
    struct CleanRun {
        std::int32_t row;
        std::int32_t begin;  ///< first column of the band
        std::int32_t end;
        std::int32_t unused = 0;  ///< in the spool
        double elevation;
    };
    /// Calls use(run) for all runs of a band, with the row of the band, in no particular order. Thread-safe
    /// after the last add().
    /// @throws OutputError if the spool cannot be read
    template <typename Use>
    void for_runs(const BandShape& band, const Use& use) const {
        slabs_.for_band(band, [&](const std::vector<SpoolEntry>& entries) {
            for (const SpoolEntry& entry : entries) {
                ByteReader reader(*spool_, entry);
                for (std::size_t i = 0; i < entry.size / sizeof(CleanRun); ++i) {
                    auto run = reader.take<CleanRun>();
                    run.row -= band.first_row;
                    if (run.row >= 0 && run.row < band.rows)
                        use(run);
                }
            }
        });
    }

  private:
    std::unique_ptr<Spool> spool_;
    std::int32_t first_col_;
    std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();  ///< guards the slabs
    RowSlabs<std::vector<SpoolEntry>> slabs_;  ///< spool entries with runs in each slab
};

/// Cleans the elevations of each building separately (contours/merge_regions), in one pass over the DEM.
/// Memory holds the buildings that the pass has begun but not finished. The result depends neither on bands
/// nor on threads.
/// @param labels labels of the buildings, from 1 to `count`
/// @param window window of the DEM
/// @param use called once per building, with its clean cells, on any thread
/// @throws Cancelled, InputError, OutputError
[[nodiscard]] CleanRows clean_tiers(ElevationReader& reader, const detect::LabelRows& labels, Label count,
                                    const RegionOptions& regions, const Window& window,
                                    const std::function<void(Label, const BuildingCells&)>& use,
                                    Context& context);

/// Returns the options that keep a strip that stands out by `detail` and is one metre wide, or one cell if
/// larger.
/// @param detail height in m
/// @param cell cell size of the raster
/// @param metres metres per vertical unit
[[nodiscard]] RegionOptions region_options(double detail, const CellSize& cell, double metres);

}  // namespace d2b::contours
