#pragma once

#include <cstdint>

#include "core/context.hpp"
#include "core/grid.hpp"
#include "dem2buildings/options.hpp"

namespace d2b {

/// Bits of Terrain::flags.
inline constexpr std::uint8_t low_outlier = 1;  ///< far below the ground around it: its height means nothing
inline constexpr std::uint8_t bare_ground = 2;  ///< the point itself is ground

/// The ground below a surface.
struct Terrain {
    /// Metres. Never above the surface where a point is valid and no low outlier; NaN everywhere where no
    /// point of the window is valid, nowhere else.
    MetreGrid elevation;
    Grid<std::uint8_t> flags;
};

/// Where the window's first cell lies on the grid of the whole raster. Windows are cut into blocks on that
/// grid.
struct GridPlace {
    std::int32_t row = 0;
    std::int32_t col = 0;
};

/// Estimates the terrain from the surface alone: what stands on it up to `max_building_width` wide is taken
/// off and the gap filled from around. The method and its sources are in docs/method.md.
/// @param surface metres, NaN where a point is not valid; its memory is used, and it is as it was afterwards
/// @throws Cancelled; an exception leaves nothing of the surface
[[nodiscard]] Terrain estimate_ground(MetreGrid& surface, const CellSize& cell, const GroundOptions& options,
                                      Context& context, const GridPlace& place = {});

/// How far, in metres, a cell must lie from a cut through a raster for the cut not to change its terrain,
/// where there is ground within `max_building_width` of it.
[[nodiscard]] double ground_halo(const CellSize& cell, const GroundOptions& options);

}  // namespace d2b
