#pragma once

#include <functional>

#include "core/context.hpp"
#include "core/grid.hpp"
#include "detect/label_rows.hpp"
#include "elevations/elevation_reader.hpp"
#include "levels/clean_rows.hpp"
#include "levels/merge_regions.hpp"

namespace d2b {

/// Cleans the elevations of each building by itself (levels/merge_regions), in one pass over the DEM. In
/// memory are the buildings that the pass has begun and not yet ended. The result depends neither on bands
/// nor on threads.
/// @param labels of the buildings, from 1 to `count` @param window of the DEM
/// @param use called once for each building, with its clean cells, on any thread @throws Cancelled,
/// InputError, OutputError
[[nodiscard]] CleanRows clean_tiers(ElevationReader& reader, const LabelRows& labels, Label count,
                                    const RegionOptions& regions, const Window& window,
                                    const std::function<void(Label, const BuildingCells&)>& use,
                                    Context& context);

/// What a strip costs that stands out by `detail` and is one metre wide, or a cell where cells are larger.
/// @param detail m @param cell of the raster
/// @param metres in a vertical unit
[[nodiscard]] RegionOptions region_options(double detail, const CellSize& cell, double metres);

}  // namespace d2b
