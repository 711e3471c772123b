#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "dem2buildings/spool.hpp"
#include "features/feature_writer.hpp"

namespace d2b {

/// Ids of the contours that each tile has drawn. Contours of all tiles arrive level by level and row by row,
/// so those of one tile are consecutive once per level. In between its ids are spooled, because memory
/// must not grow with the number of contours.
class TileNumbers {
  public:
    TileNumbers(std::unique_ptr<Spool> spool, std::size_t tiles);

    /// Returns the ids that a tile's contours of the current level need: contours of the level below, those
    /// of this level so far, and buildings. Valid until put_aside() of the tile. @throws OutputError the
    /// spool cannot be read
    [[nodiscard]] GivenNumbers& of(std::size_t tile);
    /// Spools a tile's ids after its last contour of a level. @throws OutputError the spool is full
    void put_aside(std::size_t tile);
    /// Returns all ids of a tile. Call after all have been spooled. @throws OutputError
    [[nodiscard]] GivenNumbers all(std::size_t tile) const;

  private:
    struct Waiting {
        SpoolEntry buildings;
        std::vector<SpoolEntry> written;  ///< one entry per level
        std::int64_t before = 0;          ///< number of contours below the last of these levels
        std::int64_t contours = 0;        ///< total number of contours
    };
    [[nodiscard]] SpoolEntry append(const std::vector<std::int64_t>& numbers, std::size_t from);
    void read(const SpoolEntry& entry, std::vector<std::int64_t>& numbers) const;

    std::unique_ptr<Spool> spool_;
    std::vector<Waiting> waiting_;
    std::unordered_map<std::size_t, GivenNumbers> at_hand_;
};

}  // namespace d2b
