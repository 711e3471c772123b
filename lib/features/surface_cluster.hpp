#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "attributes/records.hpp"
#include "features/surface_lattice.hpp"
#include "features/write_features.hpp"
#include "surface/make_surfaces.hpp"

namespace d2b {

class ProblemLayer;

/// What surfaces are made from.
struct SurfaceInput {
    const FeatureInput& features;
    const RecordMaker& records;
    const BuildingRecords& buildings;
    const SurfaceLattice& lattice;
    SurfaceOf of;
    SurfaceRoof roof;
    ProblemLayer* problems = nullptr;  ///< gets what was in the way, where it is asked for
};

/// A building that is in no surface.
struct LostBuilding {
    std::int64_t id = 0;
    double area_m2 = 0;
    std::optional<FinePoint> corner;  ///< one of it, on the lattice of the surface; nothing where it is torn
};

/// What a group of contours has to give.
struct DrawnCluster {
    SurfaceCluster cluster;
    std::vector<BuildingRecord> buildings;  ///< of the cluster's, in their order
    std::vector<std::int32_t> levels;       ///< of its contours, in their order
    std::vector<LostBuilding> lost;         ///< those that have no ground, no height or no place in the CRS
};

/// The height of the roof of a building that is one block, on the lattice. With SurfaceRoof::mean the block
/// encloses the volume that the record has, because areas are measured on the ellipsoid and the height makes
/// up for what the plane of the CRS differs from it. Where that is more than a hundredth, as in Web Mercator,
/// the plane has no true lengths, and the height stays what it is.
/// @param placed its footprint, on the lattice
[[nodiscard]] std::int64_t block_roof(const BuildingRecord& record, SurfaceRoof roof,
                                      const FinePolygon& placed, const SurfaceLattice& lattice);

/// Pinches that were taken apart have made blocks narrower or wider: raises or lowers their roofs, so that
/// they enclose what they did. @param area of the roof of each building in square steps; 0: it was not made
/// @return whether a block differed by more than a few hundredths of a percent
[[nodiscard]] bool fit_roofs(const std::vector<double>& area, SurfaceCluster& cluster);

/// The outlines and heights of the buildings in a group, on the lattice of the surface.
/// @param contours ascending @param transform to the CRS of the output; one a thread
[[nodiscard]] DrawnCluster draw_cluster(const SurfaceInput& input, std::span<const std::uint32_t> contours,
                                        std::optional<RingTransform>& transform);

}  // namespace d2b
