#pragma once

#include <vector>

#include "detect/detection.hpp"
#include "detect/regions.hpp"
#include "detect/smooth_segments.hpp"

namespace d2b {

/// Rectangularity that is equally common among crowns and buildings in ambiguous cases, see BorderSums.
constexpr double even_right_angles = 0.3;
/// Compactness that is equally common among small crowns and small buildings, see FormSums.
constexpr double even_compactness = 0.905;

/// Features of an object, the input of the classifier.
struct Evidence {
    double smooth = 0;    ///< share of its cells that are smooth enough
    double step_m = 0;    ///< mean fall of its border cells to their lowest neighbour
    double tilt = 0;      ///< tilt of its segments: geometric mean over cells
    double segment = 0;   ///< size of its segments in cells: geometric mean over cells
    double green = 0;     ///< share of its cells with the NDVI of plants
    double walled = 1;    ///< share of its border at which the surface bends like a wall; the raster's own
                          ///< border is ignored; 1 if there is no other border
    double fall = 0;      ///< mean slope of its border down to the lowest neighbour (m/m)
    double beside_m = 0;  ///< mean height of its surroundings, see BorderSums
    double right_angles = even_right_angles;  ///< rectangularity of its border, see BorderSums
    double area_m2 = 1;
    double gentle = 1;  ///< share of neighbouring cells with the slope of a roof, see GentlePairs
    double compactness = even_compactness;  ///< see FormSums
};

/// Objects detected so far.
struct DetectedObjects {
    Mask cells;
    Regions regions;  ///< 4-connected regions of these cells
};

/// Computes the features of each region, by label - 1. Halo: objects, and a cell around them.
[[nodiscard]] std::vector<Evidence> collect_evidence(const Scene& scene, const DetectedObjects& objects,
                                                     const SmoothSegments& segments,
                                                     const Grid<std::uint8_t>& flags, Executor& threads);

/// Classifies an object by a logistic model of eleven terms. Its weights were fitted to cities with cells of
/// 0.5 to 5 m, and validated by leaving out one city at a time, see docs/accuracy.md. Objects almost without
/// walls, sharp or blurred, are terrain, however smooth and large they are, so their confidence is 0. A term
/// that took no part is never reported as the doubt.
/// In sparse scans crowns have steps like walls, and few cells of a house are smooth. Therefore other terms
/// replace smoothness, step and tilt as the share of filled cells rises.
/// @param filled share of cells without a pulse, see filled_share()
[[nodiscard]] DetectedObject judge(const Evidence& evidence, double filled = 0);

/// Score of a part of an object for being a roof: the usual sum of judge() without the terms for vegetation
/// and right angles, because one side of the part's border is inside a roof. Parts are small, so the size of
/// their segments counts a quarter.
[[nodiscard]] double roof_likeness(const Evidence& part);

}  // namespace d2b
