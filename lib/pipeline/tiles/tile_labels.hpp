#pragma once

#include <span>
#include <vector>

#include "core/lattice.hpp"
#include "detect/label_rows.hpp"
#include "features/row_spans.hpp"
#include "pipeline/tiles/tile_run.hpp"
#include "tiles/joined_tile.hpp"

namespace d2b {

/// The labels of a tile's buildings and of others around them, wherever they lie.
class TileLabels {
  public:
    /// Reads what the tiles found that have units in the window. @throws InputError
    TileLabels(const TileRun& run, const JoinedTile& joined);

    /// Of the tile's own buildings alone.
    [[nodiscard]] LabelRows own(Context& context) const;
    /// By label - 1, whether a building of another tile lies so near. @param reach rows and columns
    [[nodiscard]] std::vector<bool> near_others(LatticePoint reach) const;
    /// The cells of buildings, and those so near to them, row by row. @param wanted by label - 1
    [[nodiscard]] std::vector<RowSpan> around(const std::vector<bool>& wanted, LatticePoint reach) const;

  private:
    /// The runs of a row of the window, from left to right.
    [[nodiscard]] std::span<const LabelRun> row(std::int32_t row) const;

    Window window_;
    Label buildings_;
    std::vector<LabelRun> runs_;  ///< in scan order; a label more than there are buildings: of another tile
    std::vector<std::size_t> first_;  ///< run of each row of the window; one more at the end
};

}  // namespace d2b
