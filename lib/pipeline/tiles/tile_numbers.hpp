#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "dem2buildings/spool.hpp"
#include "features/feature_writer.hpp"

namespace d2b {

/// The numbers of what each tile has drawn. Contours of all tiles come level by level, and row by row within
/// a level, so that those of a tile come together, once a level: in between its numbers wait in a spool, and
/// memory does not grow with contours.
class TileNumbers {
  public:
    TileNumbers(std::unique_ptr<Spool> spool, std::size_t tiles);

    /// Those of a tile that contours of a level need: of the level below and, so far, of this one; and of its
    /// buildings. Valid until put_aside() of the tile. @throws OutputError the spool cannot be read
    [[nodiscard]] GivenNumbers& of(std::size_t tile);
    /// No more contours of the tile come on this level. @throws OutputError the spool has no room
    void put_aside(std::size_t tile);
    /// All of a tile, once all are put aside. @throws OutputError
    [[nodiscard]] GivenNumbers all(std::size_t tile) const;

  private:
    struct Waiting {
        SpoolEntry buildings;
        std::vector<SpoolEntry> written;  ///< a level each
        std::int64_t before = 0;          ///< contours below the last of these levels
        std::int64_t contours = 0;        ///< of all of them
    };
    [[nodiscard]] SpoolEntry append(const std::vector<std::int64_t>& numbers, std::size_t from);
    void read(const SpoolEntry& entry, std::vector<std::int64_t>& numbers) const;

    std::unique_ptr<Spool> spool_;
    std::vector<Waiting> waiting_;
    std::unordered_map<std::size_t, GivenNumbers> at_hand_;
};

}  // namespace d2b
