#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "features/record_builder.hpp"
#include "features/surface_lattice.hpp"
#include "features/write_features.hpp"
#include "surface/make_surfaces.hpp"

namespace d2b::features {

class ProblemLayer;

/// Input of surfaces.
struct SurfaceInput {
    const FeatureInput& features;
    const RecordBuilder& records;
    const BuildingRecords& buildings;
    const SurfaceLattice& lattice;
    SurfaceOf of;
    SurfaceRoof roof;
    ProblemLayer* problems = nullptr;  ///< receives the problems; null if not asked for
};

/// Building missing from the surfaces.
struct LostBuilding {
    std::int64_t id = 0;
    double area_m2 = 0;
    std::optional<FinePoint> corner;  ///< one of its corners on the surface lattice; nullopt if torn
};

/// Cluster of contours prepared for a surface.
struct DrawnCluster {
    surface::SurfaceCluster cluster;
    std::vector<BuildingRecord> buildings;  ///< records of the cluster's buildings
    std::vector<std::int32_t> levels;       ///< levels of its contours
    std::vector<LostBuilding> lost;         ///< buildings without ground, height or position in the CRS
    std::vector<std::int64_t> stacked;  ///< ids of buildings that have tiers instead of the planes of roofs
    std::int64_t levelled_faces = 0;    ///< faces of roofs that would reach below the ground
};

/// Returns the roof height of a single-block building on the lattice. With SurfaceRoof::mean the block
/// encloses the volume in the record. Areas are measured on the ellipsoid, so the height compensates for the
/// distortion of the CRS's plane, unless this is above 1 % as in Web Mercator, because such a plane has no
/// true lengths.
/// @param placed its footprint, on the lattice
[[nodiscard]] std::int64_t block_roof(const BuildingRecord& record, SurfaceRoof roof,
                                      const FinePolygon& placed, const SurfaceLattice& lattice);

/// Adjusts roof heights so that blocks keep their volumes after resolving non-manifold vertices has changed
/// their areas. @param area of each building's roof in square steps; 0 if it was not made
/// @return true if a block differed by more than a few hundredths of a percent
[[nodiscard]] bool preserve_volumes(const std::vector<double>& area, surface::SurfaceCluster& cluster);

/// Collects the outlines and heights of the buildings in a group, on the surface lattice.
/// @param contours ascending @param transform to the output CRS; one per thread
/// @param stacked ids of buildings to draw as tiers, with SurfaceOf::roofs
[[nodiscard]] DrawnCluster draw_cluster(const SurfaceInput& input, std::span<const std::uint32_t> contours,
                                        std::optional<RingTransform>& transform,
                                        const std::set<std::int64_t>& stacked = {});

/// Merges each tier with the one below if their areas differ by at most 0.1 %: the outline of the lower one
/// is kept, at the height of the upper one. Also merges tiers that would no longer be higher than the tier
/// below.
/// @param drawn contours of surfaces; merged tiers are removed
void merge_equal_tiers(DrawnCluster& drawn);

/// Converts the buildings of a cluster to stacks of tiers, one part per building, with ids but without field
/// values.
/// @param drawn from contours (SurfaceOf::contours)
[[nodiscard]] std::vector<SurfacePart> building_tiers(const DrawnCluster& drawn, SurfaceRoof roof,
                                                      const SurfaceLattice& lattice);

}  // namespace d2b::features
