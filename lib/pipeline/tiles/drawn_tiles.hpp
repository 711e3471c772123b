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

/// What all tiles have drawn and left.
class DrawnTiles {
  public:
    DrawnTiles(const TileRun& run, Context& context);

    Tally tally;
    int levels = 1;
    std::int64_t buildings = 0;
    StackError error;
    std::vector<DrawnStream> streams;
    std::unique_ptr<StoredContours> left;
    std::vector<Footprint> footprints{{}};  ///< of what is left, by label
    LevelPlan plan;                         ///< likewise
    Label sure = 0;                         ///< of these labels
    std::vector<std::int64_t> tiles{-1};    ///< that have left them, likewise
    LeftElevations elevations;

  private:
    void take(DrawnTile&& tile);
    void number_left(double metres);

    // Tiles are read by turns: what the system would read ahead is gone when it is asked for.
    RecentFiles files_{RecentFiles::ReadAhead::none};  ///< of the streams

    std::vector<LeftBuilding> left_buildings_;  ///< of one tile after the other
    std::vector<std::int64_t> left_by_;         ///< the tile of each
    std::vector<LeftContour> left_;             ///< likewise, with labels and parents among all
};

}  // namespace d2b
