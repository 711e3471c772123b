#pragma once

#include <cstdint>

#include "core/context.hpp"
#include "core/grid.hpp"
#include "dem2buildings/options.hpp"
#include "ground/rules.hpp"

namespace d2b::ground {

/// Bits of Terrain::flags.
inline constexpr std::uint8_t low_outlier = 1;  ///< far below the ground around it; its height is invalid
inline constexpr std::uint8_t bare_ground = 2;  ///< the point itself is ground

/// Terrain below a surface.
struct Terrain {
    /// Metres. Never above the surface, except at low outliers and points that are not valid. NaN everywhere
    /// if the window has no valid point, and nowhere otherwise.
    MetreGrid elevation;
    Grid<std::uint8_t> flags;
};

/// Position of the window's first cell on the grid of the whole raster, because blocks are aligned to that
/// grid.
struct GridOrigin {
    std::int32_t row = 0;
    std::int32_t col = 0;
};

/// Estimates the terrain from the surface alone: removes objects up to `max_building_width` wide and fills
/// the gaps from their surroundings. Based on progressive morphological opening (SMRF: Pingel, Clarke and
/// McBride, 2013), extended by walls, which tell roofs from hills; docs/method.md describes the method. If a
/// terrain model is available, use open_terrain() (read/side_rasters.hpp) instead.
/// @param surface metres, NaN for points that are not valid; its memory is used temporarily and its values
/// are restored
/// @throws Cancelled; an exception destroys the surface
[[nodiscard]] Terrain estimate_ground(MetreGrid& surface, const CellSize& cell, const GroundOptions& options,
                                      Context& context, const GridOrigin& place = {});

/// Distance in metres from a cut through a raster beyond which the cut does not change the terrain, provided
/// there is ground within `max_building_width` of each cell.
[[nodiscard]] double ground_halo(const CellSize& cell, const GroundOptions& options);

/// Same as estimate_ground() with given rules. @param width of the widest building, metres
[[nodiscard]] Terrain estimate(MetreGrid& surface, const CellSize& cell, double width, const Context& context,
                               const GridOrigin& place, const Rules& rules);

/// Same as ground_halo() with given rules.
[[nodiscard]] double halo(const CellSize& cell, double width, const Rules& rules);

}  // namespace d2b::ground
