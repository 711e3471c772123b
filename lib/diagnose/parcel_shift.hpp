#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "detect/detection.hpp"

namespace d2b {

/// Steps of a roof, see roof_step(), that stand out as a wall between houses, and not as a dormer.
inline constexpr float walls_to_steps = 2;

/// How much of the borders of parcels would lie on walls if all parcels were moved, for each of some moves,
/// as counts: they add up whatever their order.
struct ShiftCounts {
    static constexpr std::int32_t most = 12;  ///< steps to all sides
    static constexpr std::int32_t side = 2 * most + 1;
    /// By steps down and right, row by row; 0 beyond reach. An edge of a cell counts 2 on a wall, and 1
    /// beside.
    std::array<std::int64_t, static_cast<std::size_t>(side) * side> on_walls{};

    /// Of a move, by steps.
    [[nodiscard]] static std::size_t index(std::int32_t down, std::int32_t right) {
        return static_cast<std::size_t>(down + most) * static_cast<std::size_t>(side) +
               static_cast<std::size_t>(right + most);
    }
    void merge(const ShiftCounts& other);
};

/// What one step is along an axis.
struct ShiftSteps {
    std::int32_t cells = 1;  ///< of the raster
    std::int32_t reach = 0;  ///< steps to both sides, at most ShiftCounts::most
};
/// Steps of half a metre, or of a cell where it is larger, some six metres to both sides.
[[nodiscard]] ShiftSteps shift_steps(double cell_m);

/// Adds the borders between own cells of a unit and their neighbours. Walls are the borders of buildings, and
/// steps of the surface in them.
/// @pre scene.parcels
void count_shifts(const Scene& scene, const Detection& detection, const Window& own, ShiftCounts& counts,
                  Executor& threads);

/// The move after which parcels lie on walls best, to the step; of moves that are as good, such as along a
/// straight row of houses, the least. Nothing where no move stands out: where hardly any border is a wall, or
/// few are seen, or other moves do as well.
/// @param cell of the DEM
[[nodiscard]] std::optional<ParcelMove> fitting_move(const ShiftCounts& counts, const CellSize& cell);

}  // namespace d2b
