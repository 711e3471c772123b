#pragma once

#include <ogr_api.h>

#include "read/polygon_layer.hpp"

namespace d2b {

/// The polygons of a geometry of any type, curves as lines, without heights of vertices; none where it has
/// none.
[[nodiscard]] PolygonFeature polygon_feature_of(OGRGeometryH geometry);

}  // namespace d2b
