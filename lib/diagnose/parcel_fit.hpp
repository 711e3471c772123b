#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/report.hpp"
#include "detect/detection.hpp"
#include "diagnose/parcel_shift.hpp"

namespace d2b {

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

/// Returns the reason why parcels may be misplaced: they touch no building, or lie next to walls instead of
/// on them. A clause without a full stop; "" if they are plausible.
[[nodiscard]] std::string misplaced_doubt(const ParcelReport& report, const CellSize& cell,
                                          const DetectOptions& options);
/// Same, if parcels overlap.
[[nodiscard]] std::string overlap_doubt(const ParcelReport& report, const DetectOptions& options);
/// Same, if some parcels are invalid.
[[nodiscard]] std::string validity_doubt(const ParcelReport& report, const DetectOptions& options);

}  // namespace d2b
