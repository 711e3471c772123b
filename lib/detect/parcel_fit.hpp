#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/report.hpp"
#include "detect/detection.hpp"

namespace d2b::detect {

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

/// Adds the parcel boundaries between core cells of a unit and their neighbours. Walls are the borders of
/// buildings, and steps of the surface inside them.
/// @pre scene.parcels
void count_shifts(const Scene& scene, const Detection& detection, const Window& own, ShiftCounts& counts,
                  Executor& threads);

/// Returns the move that brings most parcel boundaries onto walls, in whole steps; the smallest of equally
/// good ones, as along a straight row of houses. nullopt if no move stands out: hardly any boundary is on a
/// wall, too few are known, or other moves are as good.
/// @param cell cell size of the DEM
[[nodiscard]] std::optional<ParcelMove> best_offset(const ShiftCounts& counts, const CellSize& cell);

/// Statistics of the fit of parcels to buildings. Integer counts, so the order does not matter.
struct ParcelFit {
    static constexpr double reach_m = 4;  ///< search distance for walls on both sides of a cut
    static constexpr std::size_t bins = 40;

    std::int64_t cells = 0;    ///< cells of buildings
    std::int64_t inside = 0;   ///< number of these in a parcel
    std::int64_t several = 0;  ///< number of these in more than one parcel
    std::int64_t invalid = 0;  ///< number of these in an invalid parcel
    std::int64_t cuts = 0;     ///< pairs of neighbours in a block that parcels separate
    std::array<std::int64_t, bins>
        distances{};  ///< histogram of the distance to a wall, for cuts within reach of one
    ShiftCounts shifts;

    void merge(const ParcelFit& other);
};

/// Adds the parcels of the core of a unit. At each cut between neighbouring cells, walls are searched across
/// the cut: the border of the block, or a step of the surface.
/// @pre scene.parcels
void add_fit(const Scene& scene, const Detection& detection, const Window& own, ParcelFit& fit,
             Executor& threads);

/// Converts counts to lengths in m.
/// @param cell cell size of the DEM
[[nodiscard]] ParcelReport parcel_report(const ParcelFit& fit, const CellSize& cell);

}  // namespace d2b::detect
