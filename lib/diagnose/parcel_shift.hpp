#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "detect/detection.hpp"

namespace d2b {

/// Factor on roof_step() from which a step counts as a wall between houses, not as a dormer.
inline constexpr float walls_to_steps = 2;

/// Length of parcel boundaries that would lie on walls if all parcels were moved, for a grid of moves.
/// Integer counts, so the order does not matter.
struct ShiftCounts {
    static constexpr std::int32_t most = 12;  ///< maximum number of steps to each side
    static constexpr std::int32_t side = 2 * most + 1;
    /// Score by steps down and right, row by row; 0 beyond reach. An edge of a cell scores 2 on a wall and 1
    /// next to one.
    std::array<std::int64_t, static_cast<std::size_t>(side) * side> on_walls{};

    /// Returns the index of a move, given in steps.
    [[nodiscard]] static std::size_t index(std::int32_t down, std::int32_t right) {
        return static_cast<std::size_t>(down + most) * static_cast<std::size_t>(side) +
               static_cast<std::size_t>(right + most);
    }
    void merge(const ShiftCounts& other);
};

/// Step of a move along an axis.
struct ShiftSteps {
    std::int32_t cells = 1;  ///< cells per step
    std::int32_t reach = 0;  ///< steps to both sides, at most ShiftCounts::most
};
/// Returns steps of half a metre (or of a cell, if larger) up to some six metres on both sides.
[[nodiscard]] ShiftSteps shift_steps(double cell_m);

/// Adds the parcel boundaries between core cells of a unit and their neighbours. Walls are the borders of
/// buildings, and steps of the surface inside them.
/// @pre scene.parcels
void count_shifts(const Scene& scene, const Detection& detection, const Window& own, ShiftCounts& counts,
                  Executor& threads);

/// Returns the move that brings most parcel boundaries onto walls, in whole steps; the smallest of equally
/// good ones, as along a straight row of houses. nullopt if no move stands out: hardly any boundary is on a
/// wall, too few are known, or other moves are as good.
/// @param cell cell size of the DEM
[[nodiscard]] std::optional<ParcelMove> fitting_move(const ShiftCounts& counts, const CellSize& cell);

}  // namespace d2b
