#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "attributes/records.hpp"
#include "filter/contour_store.hpp"
#include "levels/level_plan.hpp"
#include "pipeline/tiles/left_elevations.hpp"
#include "pipeline/tiles/tile_run.hpp"
#include "tiles/drawn_tile.hpp"
#include "tiles/recent_files.hpp"

namespace d2b {

/// Contours drawn by all tiles, and those that they left to the merge step.
class DrawnTiles {
  public:
    DrawnTiles(const TileRun& run, Context& context);

    Tally tally;
    int levels = 1;
    std::int64_t buildings = 0;
    StackError error;
    std::vector<DrawnStream> streams;
    std::unique_ptr<StoredContours> left;
    std::vector<Footprint> footprints{{}};  ///< footprints of deferred buildings, by label
    LevelPlan plan;                         ///< thresholds of deferred buildings, by label
    Label sure = 0;  ///< number of deferred labels that are buildings; higher ones are low-confidence
    std::vector<std::int64_t> tiles{-1};  ///< tile that deferred each label
    LeftElevations elevations;

  private:
    void take(DrawnTile&& tile);
    void number_left(double metres);

    // No read-ahead, because tiles are read in turns and the cached pages would be evicted before use.
    RecentFiles files_{RecentFiles::ReadAhead::none};  ///< file handles of the streams

    std::vector<LeftBuilding> left_buildings_;  ///< concatenated over tiles
    std::vector<std::int64_t> left_by_;         ///< tile of each left_buildings_ entry
    std::vector<LeftContour> left_;  ///< concatenated over tiles, with labels and parents renumbered
};

}  // namespace d2b
