#pragma once

#include <cstdint>
#include <vector>

#include "core/context.hpp"
#include "pipeline/given_footprints.hpp"
#include "pipeline/tiles/tile_run.hpp"

namespace d2b::tiles {

/// Given footprints that a tile sees, with their cells there and nothing else.
struct PlannedFootprints {
    pipeline::GivenFootprints footprints;
    std::vector<std::uint64_t> indices;  ///< of each in the order of the source
};

/// Returns none for a run without footprints. @throws InputError
[[nodiscard]] PlannedFootprints load_planned_footprints(TileRun& run, std::int64_t tile);

/// Adds the statistics of footprints from all tiles, as if units had come row by row. @throws InputError
void add_seen_footprints(const TileRun& run, pipeline::GivenFootprints& given);

}  // namespace d2b::tiles
