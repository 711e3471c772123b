#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/context.hpp"
#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/correction_source.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/parcel_source.hpp"

namespace d2b::detect {

/// Parcels of the cells of a scene.
using ParcelGrid = Grid<ParcelCell>;

/// True if a parcel boundary separates two neighbours.
/// @param below true if the second cell is below the first, false if it is to the right
[[nodiscard]] inline bool separated_by_parcel(const ParcelCell& first, const ParcelCell& second, bool below) {
    return first.parcel != second.parcel || (below ? first.cut_below : first.cut_right);
}

/// Part of a correction that lies in a scene, in rows and columns of the scene.
struct SceneCorrection {
    std::size_t index = 0;  ///< among all corrections
    CorrectionKind kind = CorrectionKind::building;
    bool is_point = false;
    std::vector<CellRun> cells;
    std::vector<CellCut> cuts;
};
/// Returns the corrections that have cells in a part of the DEM. @param part extent of the scene
[[nodiscard]] std::vector<detect::SceneCorrection> corrections_in(const std::vector<Correction>& all,
                                                                  const Window& part);

/// Cells with an NDVI above this are vegetation.
inline constexpr float vegetation_ndvi = 0.3F;

/// Input of the detection. All grids have the same shape.
struct Scene {
    const MetreGrid& surface;  ///< the DSM, NaN in cells that are not valid
    const MetreGrid& terrain;  ///< never NaN if the surface is valid
    CellSize cell;
    const Mask* allowed = nullptr;                ///< cells in which buildings are searched; null: everywhere
    const MetreGrid* greenness = nullptr;         ///< NDVI, NaN if unknown; may be null
    const detect::ParcelGrid* parcels = nullptr;  ///< parcels that divide buildings; may be null
    std::span<const detect::SceneCorrection> corrections = {};
    /// Greatest length in m of roofs that an estimated terrain may pass through, see add_swallowed_roofs();
    /// 0: none, because the terrain is given.
    double longest_swallowed = 0;

    [[nodiscard]] float height(std::size_t i) const { return surface.values[i] - terrain.values[i]; }
    /// Side in metres of a square cell of the same area.
    [[nodiscard]] double side() const;
    [[nodiscard]] double cell_area() const { return cell.area(); }
};

/// Returns the smallest number of cells that cover an area, capped at a number no raster reaches.
[[nodiscard]] std::int64_t cells_covering(double area_m2, const CellSize& cell);

/// Returns the cells within the allowed area of which is(elevation, terrain) is true.
template <typename Is>
[[nodiscard]] Mask cells_where(const detect::Scene& scene, const Is& is, Executor& threads) {
    Mask result = Mask::unset(scene.surface.rows, scene.surface.cols, threads);
    for_rows(threads, result.rows, result.cols, [&](std::int32_t r) {
        // Local spans, because stores of bytes may alias anything and would otherwise prevent vectorisation.
        // Same wherever bytes of cells are written.
        const std::span<const float> z = scene.surface.row(r);
        const std::span<const float> ground = scene.terrain.row(r);
        const std::span<std::uint8_t> out = result.row(r);
        for (std::size_t c = 0; c < out.size(); ++c)
            out[c] = is(z[c], ground[c]) ? 1 : 0;
        if (scene.allowed == nullptr)
            return;
        const std::span<const std::uint8_t> allowed = scene.allowed->row(r);
        for (std::size_t c = 0; c < out.size(); ++c)
            out[c] = allowed[c] != 0 ? out[c] : std::uint8_t{0};
    });
    return result;
}

/// Returns the cells higher above the terrain than a threshold, within the allowed area.
[[nodiscard]] Mask elevated_cells(const detect::Scene& scene, double min_height, Executor& threads);

/// Height difference in m between neighbouring cells that are separated by a wall. It is more than roofs
/// rise: 63 degrees in cells of 0.5 m, 56 degrees in cells of a metre and more.
[[nodiscard]] inline float roof_step(const detect::Scene& scene) {
    constexpr double least = 1;
    constexpr double slope = 1.5;
    return static_cast<float>(std::max(least, slope * scene.side()));
}

/// Reads a part of a source's window and multiplies it by a factor.
/// @throws InputError
[[nodiscard]] MetreGrid read_grid(DemSource& source, const Window& part, double factor, Context& context);
/// Reads a mask: cells that are neither 0 nor invalid.
/// @throws InputError
[[nodiscard]] Mask read_mask(DemSource& source, const Window& part, Context& context);

}  // namespace d2b::detect
