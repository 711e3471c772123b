#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/band.hpp"
#include "core/byte_record.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Single cells of bands with a decision that holds for the whole run, spooled to disk, because every fourth
/// cell of a raster of noise is one.
class BandCells {
  public:
    /// Indices into the elevations of a band, ascending.
    struct Cells {
        std::vector<std::size_t> invalid;
        std::vector<std::size_t> spires;
    };
    explicit BandCells(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// Appends the cells of the next band.
    /// @throws OutputError if there is no space
    void append(const Cells& cells);
    /// Sets invalid cells to NaN, and marks the spires; does nothing if the band has not been appended yet.
    /// Thread-safe.
    /// @param cols columns of the band
    /// @param part part of the window covered by `cells`; rows and columns relative to the band
    /// @throws OutputError
    void apply(std::size_t band, std::int32_t cols, const Window& part, ElevationBand& cells) const;

    /// Returns the indices of a band's invalid cells.
    /// @throws OutputError
    [[nodiscard]] std::vector<std::size_t> invalid(std::size_t band) const;

  private:
    struct Entry {
        SpoolEntry place;
        std::size_t invalid = 0;
    };
    std::unique_ptr<Spool> spool_;
    std::vector<Entry> bands_;
};

}  // namespace d2b
