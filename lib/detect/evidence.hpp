#pragma once

#include <vector>

#include "detect/detection.hpp"
#include "detect/regions.hpp"
#include "detect/smooth_segments.hpp"

namespace d2b {

/// So many right angles are as common among crowns as among buildings where one may be taken for the other,
/// see BorderSums.
constexpr double even_right_angles = 0.3;
/// Small objects that are as compact are as often crowns, see FormSums.
constexpr double even_compactness = 0.905;

/// What an object looks like.
struct Evidence {
    double smooth = 0;    ///< share of its cells that are smooth enough
    double step_m = 0;    ///< mean fall of its border cells to the lowest cell beside them
    double tilt = 0;      ///< of its segments: geometric mean by cells
    double segment = 0;   ///< cells of its segments: geometric mean by cells
    double green = 0;     ///< share of its cells with the NDVI of plants
    double walled = 1;    ///< share of its border where the surface bends as at a wall; the raster's own
                          ///< border is left out, and where there is no other it is not known: 1
    double fall = 0;      ///< mean slope of its border, down to the lowest cell beside it, metres a metre
    double beside_m = 0;  ///< mean height of what is beside it, see BorderSums
    double right_angles = even_right_angles;  ///< how well its border keeps to them, see BorderSums
    double area_m2 = 1;
    double gentle = 1;  ///< share of its neighbours that are as near in height as on a roof, see GentlePairs
    double compactness = even_compactness;  ///< see FormSums
};

/// What detection found so far.
struct DetectedObjects {
    Mask cells;
    Regions regions;  ///< of these cells; they share edges
};

/// One a region, by label - 1. Halo: objects, and a cell around them.
[[nodiscard]] std::vector<Evidence> collect_evidence(const Scene& scene, const DetectedObjects& objects,
                                                     const SmoothSegments& segments,
                                                     const Grid<std::uint8_t>& flags, Executor& threads);

/// A logistic model of six terms. Its weights were fitted to cities of 0.5 to 5 m cells; each city was also
/// left out in turn, see docs/accuracy.md. What has next to no wall, neither sharp nor smeared, is part of
/// the ground, however smooth and large it is: its confidence is 0. A term that took no part is no doubt.
/// Where points are thin, crowns have steps like walls, and few cells of a house are smooth: as the share
/// of filled cells rises, other terms take the place of smoothness, step and tilt.
/// @param filled share of the cells that no pulse met, see filled_share()
[[nodiscard]] DetectedObject judge(const Evidence& evidence, double filled = 0);

/// What speaks for a part of an object being a roof: judge()'s usual sum without the green and the right
/// angles, since a part's border is a roof's on one side. Parts are small, so the size of their segments
/// counts a quarter of what an object's does.
[[nodiscard]] double roof_likeness(const Evidence& part);

}  // namespace d2b
