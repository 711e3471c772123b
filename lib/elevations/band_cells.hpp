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

/// Single cells of bands of which something is known for the whole run. They wait in a spool: of rasters that
/// are noise every fourth cell is one.
class BandCells {
  public:
    /// Indices of a band's elevations, ascending.
    struct Cells {
        std::vector<std::size_t> invalid;
        std::vector<std::size_t> spires;
    };
    explicit BandCells(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// Of the next band. @throws OutputError there is no room
    void append(const Cells& cells);
    /// Makes NaN of what is invalid, and marks the spires; nothing where the band's cells are not there yet.
    /// From any thread. @param cols of the band @param part of the window that `cells` are; rows and columns
    /// counted from the band's first @throws OutputError
    void apply(std::size_t band, std::int32_t cols, const Window& part, ElevationBand& cells) const;

    /// Indices of what of a band is invalid. @throws OutputError
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
