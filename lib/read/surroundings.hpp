#pragma once

#include <vector>

#include <ogr_srs_api.h>

#include "dem2buildings/dem_source.hpp"
#include "read/ring_clip.hpp"

namespace d2b {

/// Search extents of polygons, and the range of valid latitudes.
struct Surroundings {
    std::vector<ClipBox> boxes;  ///< empty: unlimited
    ClipBox earth;               ///< latitudes between the poles
};

/// Returns the extents, in the CRS of the polygons, in which they can affect the window of a DEM: the window
/// and four times its size on all sides. Polygons farther away may have no image in the CRS of the DEM, or
/// one at an arbitrary position. For geographic CRSs, the same place is in several boxes, one turn apart.
/// @param polygons, dem coordinate reference systems, neither null
/// @return no boxes if they cannot be determined
[[nodiscard]] Surroundings surroundings(OGRSpatialReferenceH polygons, OGRSpatialReferenceH dem,
                                        const DemInfo& info);

}  // namespace d2b
