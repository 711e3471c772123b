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

/// Merges the streams of drawn contours of all tiles into one sequence ordered by key.
class DrawnSequence {
  public:
    /// @param streams by tile; all references must outlive this
    /// @param parts null if features go into one dataset
    /// @param spool for numbers that are not in memory
    DrawnSequence(std::vector<DrawnStream>& streams, FeatureWriter& writer, PartNumbers* parts,
                  std::unique_ptr<Spool> spool);

    /// Writes all contours before a key, or all remaining ones if there is no key. @throws InputError,
    /// OutputError
    void write_before(const std::optional<ContourKey>& end);
    /// Returns the ids assigned so far, by tile.
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
