#pragma once

#include <cstdint>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "detect/parcel_grid.hpp"

namespace d2b {

/// Cells with an NDVI above this are vegetation.
inline constexpr float plants_ndvi = 0.3F;

/// Input of the detection. All grids have the same shape.
struct Scene {
    const MetreGrid& surface;  ///< the DSM, NaN in cells that are not valid
    const MetreGrid& terrain;  ///< never NaN if the surface is valid
    CellSize cell;
    const Mask* allowed = nullptr;         ///< cells in which buildings are searched; null: everywhere
    const MetreGrid* greenness = nullptr;  ///< NDVI, NaN if unknown; may be null
    const ParcelGrid* parcels = nullptr;   ///< parcels that divide buildings; may be null

    [[nodiscard]] float height(std::size_t i) const { return surface.values[i] - terrain.values[i]; }
    /// Side in metres of a square cell of the same area.
    [[nodiscard]] double side() const;
    [[nodiscard]] double cell_area() const { return cell.area(); }
};

/// Returns the smallest number of cells that cover an area, capped at a number no raster reaches.
[[nodiscard]] std::int64_t cells_for(double area_m2, const CellSize& cell);

/// Returns the cells higher above the terrain than a threshold, within the allowed area.
[[nodiscard]] Mask elevated_cells(const Scene& scene, double min_height, Executor& threads);

}  // namespace d2b
