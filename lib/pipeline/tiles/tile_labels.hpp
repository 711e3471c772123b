#pragma once

#include <span>
#include <vector>

#include "core/lattice.hpp"
#include "detect/label_rows.hpp"
#include "features/row_spans.hpp"
#include "pipeline/tiles/tile_run.hpp"
#include "tiles/joined_tile.hpp"

namespace d2b {

/// Labels of the buildings that a tile draws, and of other buildings near them, whichever tile found them.
class TileLabels {
  public:
    /// Reads the detection results of all tiles with units in the window. @throws InputError
    TileLabels(const TileRun& run, const JoinedTile& joined);

    /// Returns the labels of the tile's own buildings.
    [[nodiscard]] LabelRows own(Context& context) const;
    /// Marks, by label - 1, buildings with another tile's building within reach. @param reach rows and
    /// columns
    [[nodiscard]] std::vector<bool> near_others(LatticePoint reach) const;
    /// Returns the cells within reach of the wanted buildings, row by row. @param wanted by label - 1
    [[nodiscard]] std::vector<RowSpan> around(const std::vector<bool>& wanted, LatticePoint reach) const;

  private:
    /// Returns the runs of a row of the window, from left to right.
    [[nodiscard]] std::span<const LabelRun> row(std::int32_t row) const;

    Window window_;
    Label buildings_;
    std::vector<LabelRun> runs_;      ///< in scan order; label buildings_ + 1 marks other tiles' buildings
    std::vector<std::size_t> first_;  ///< first run of each row of the window; one more at the end
};

}  // namespace d2b
