#pragma once

#include <cstdint>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "detect/parcel_grid.hpp"

namespace d2b {

/// An NDVI above this is that of plants.
inline constexpr float plants_ndvi = 0.3F;

/// What detection looks at. All grids have the same shape.
struct Scene {
    const MetreGrid& surface;  ///< the DSM, NaN where a point is not valid
    const MetreGrid& terrain;  ///< never NaN where the surface is valid
    CellSize cell;
    const Mask* allowed = nullptr;  ///< cells where buildings are looked for; everywhere where there is none
    const MetreGrid* greenness = nullptr;  ///< NDVI, NaN where unknown; may be missing
    const ParcelGrid* parcels = nullptr;   ///< what cuts buildings; may be missing

    [[nodiscard]] float height(std::size_t i) const { return surface.values[i] - terrain.values[i]; }
    /// The side of a square cell of the same area, in metres.
    [[nodiscard]] double side() const;
    [[nodiscard]] double cell_area() const { return cell.area(); }
};

/// The fewest cells that cover an area; where no number of them does, more than there ever are.
[[nodiscard]] std::int64_t cells_for(double area_m2, const CellSize& cell);

/// Cells that rise above the terrain by more than a height, where buildings are allowed.
[[nodiscard]] Mask elevated_cells(const Scene& scene, double min_height, Executor& threads);

}  // namespace d2b
