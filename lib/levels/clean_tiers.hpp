#pragma once

#include <functional>

#include "core/context.hpp"
#include "core/grid.hpp"
#include "detect/label_rows.hpp"
#include "elevations/elevation_reader.hpp"
#include "levels/clean_rows.hpp"
#include "levels/merge_regions.hpp"

namespace d2b {

/// Cleans the elevations of each building separately (levels/merge_regions), in one pass over the DEM. Memory
/// holds the buildings that the pass has begun but not finished. The result depends neither on bands nor on
/// threads.
/// @param labels labels of the buildings, from 1 to `count`
/// @param window window of the DEM
/// @param use called once per building, with its clean cells, on any thread
/// @throws Cancelled, InputError, OutputError
[[nodiscard]] CleanRows clean_tiers(ElevationReader& reader, const LabelRows& labels, Label count,
                                    const RegionOptions& regions, const Window& window,
                                    const std::function<void(Label, const BuildingCells&)>& use,
                                    Context& context);

/// Returns the options that keep a strip that stands out by `detail` and is one metre wide, or one cell if
/// larger.
/// @param detail height in m
/// @param cell cell size of the raster
/// @param metres metres per vertical unit
[[nodiscard]] RegionOptions region_options(double detail, const CellSize& cell, double metres);

}  // namespace d2b
