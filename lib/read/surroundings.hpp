#pragma once

#include <vector>

#include <ogr_srs_api.h>

#include "dem2buildings/dem_source.hpp"
#include "read/ring_clip.hpp"

namespace d2b {

/// Where polygons may matter, and where they can be.
struct Surroundings {
    std::vector<ClipBox> boxes;  ///< empty: everywhere
    ClipBox earth;               ///< latitudes between the poles
};

/// Where polygons may matter to the window of a DEM, in the CRS of the polygons: around the window, and four
/// times its size to all sides. What lies farther away need have no image in the CRS of the DEM, or has one
/// anywhere. Where longitudes count around the Earth, the same place is in several boxes, a turn apart.
/// @param polygons, dem their coordinate reference systems, neither null
/// @return no boxes where that cannot be told
[[nodiscard]] Surroundings surroundings(OGRSpatialReferenceH polygons, OGRSpatialReferenceH dem,
                                        const DemInfo& info);

}  // namespace d2b
