#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "features/feature_writer.hpp"
#include "pipeline/tiles/part_numbers.hpp"
#include "pipeline/tiles/tile_numbers.hpp"
#include "tiles/drawn_tile.hpp"

namespace d2b {

/// Hands out what tiles have drawn in the order of keys.
class DrawnSequence {
  public:
    /// @param streams by tile; they must outlive this, as the others must
    /// @param parts null where features go into one dataset
    /// @param spool for numbers that wait
    DrawnSequence(std::vector<DrawnStream>& streams, FeatureWriter& writer, PartNumbers* parts,
                  std::unique_ptr<Spool> spool);

    /// Writes what comes before a key; without one all that is left. @throws InputError, OutputError
    void write_before(const std::optional<ContourKey>& end);
    /// Of what each tile has drawn.
    [[nodiscard]] TileNumbers& numbers() { return numbers_; }

  private:
    using Next = std::pair<ContourKey, std::size_t>;
    std::vector<DrawnStream>& streams_;
    FeatureWriter& writer_;
    PartNumbers* parts_;
    TileNumbers numbers_;
    std::priority_queue<Next, std::vector<Next>, std::greater<>> next_;
};

}  // namespace d2b
