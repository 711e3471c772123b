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

/// How parcels lie to buildings, as counts: they add up whatever their order.
struct ParcelFit {
    static constexpr double reach_m = 4;  ///< that walls are looked for on both sides of a cut
    static constexpr std::size_t bins = 40;

    std::int64_t cells = 0;                      ///< of buildings
    std::int64_t inside = 0;                     ///< of these, in a parcel
    std::int64_t several = 0;                    ///< of these, in more than one
    std::int64_t invalid = 0;                    ///< of these, in one that is not valid
    std::int64_t cuts = 0;                       ///< neighbours in a block that parcels part
    std::array<std::int64_t, bins> distances{};  ///< of these, those with a wall within reach, by distance
    ShiftCounts shifts;

    void merge(const ParcelFit& other);
};

/// Adds what parcels are to the own cells of a unit. From where they part neighbours walls are looked for
/// across the cut: the border of the block, or a step of the surface.
/// @pre scene.parcels
void add_fit(const Scene& scene, const Detection& detection, const Window& own, ParcelFit& fit,
             Executor& threads);

/// In metres. @param cell of the DEM
[[nodiscard]] ParcelReport parcel_report(const ParcelFit& fit, const CellSize& cell);

/// Why parcels are doubtful: they touch no building, or lie beside walls. Without a full stop; "" where they
/// are not.
[[nodiscard]] std::string misplaced_doubt(const ParcelReport& report, const CellSize& cell,
                                          const DetectOptions& options);
/// That they overlap. Likewise.
[[nodiscard]] std::string overlap_doubt(const ParcelReport& report, const DetectOptions& options);
/// That some are not valid. Likewise.
[[nodiscard]] std::string validity_doubt(const ParcelReport& report, const DetectOptions& options);

}  // namespace d2b
