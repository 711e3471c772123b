#pragma once

#include <vector>

#include <ogr_api.h>

#include "read/polygon_layer.hpp"

namespace d2b {

/// Polygons, triangles as well, that a geometry is or holds at any depth, in its order. They live as long as
/// it does.
[[nodiscard]] std::vector<OGRGeometryH> polygons_within(OGRGeometryH geometry);
/// Likewise lines; edges of polygons are none.
[[nodiscard]] std::vector<OGRGeometryH> lines_within(OGRGeometryH geometry);

/// The polygons of a geometry of any type, curves as lines, without heights of vertices; none where it has
/// none.
[[nodiscard]] PolygonFeature polygon_feature_of(OGRGeometryH geometry);

}  // namespace d2b
