#pragma once

#include <cstdint>
#include <vector>

#include "core/stop_token.hpp"
#include "roofs/building_grid.hpp"
#include "roofs/plane.hpp"

namespace d2b::roofs {

struct SegmentOptions {
    double price_m3 = 0.5;  ///< squared error that a metre of border has to save
    double min_area_m2 = 4;
};

/// Segmentation of a building: connected cells that lie on one plane have one label.
struct PlaneSegments {
    std::vector<Plane> planes;         ///< by label
    std::vector<std::int32_t> labels;  ///< by cell of the grid; -1 outside of the building
};

/// Segments the roof of a building into planes that minimise the squared error of its elevations plus a price
/// on the length of their borders: the piecewise affine model of Mumford and Shah (1989), by merging the
/// neighbours whose union costs least per length of border (Koepfler, Lopez and Morel 1994), followed by
/// rounds of robust fits (Tukey 1977) and relaxation of the labels (Besag 1986).
/// @throws Cancelled
[[nodiscard]] PlaneSegments segment_planes(const BuildingGrid& grid, const SegmentOptions& options,
                                           const StopToken& stop);

/// Fits the planes of labels robustly: points far from their plane hardly count.
[[nodiscard]] std::vector<Plane> fit_planes(const BuildingGrid& grid, const std::vector<std::int32_t>& labels,
                                            std::size_t count);

}  // namespace d2b::roofs
