#pragma once

#include <vector>

#include <ogr_api.h>

#include "read/polygon_layer.hpp"

namespace d2b {

/// Returns the polygons and triangles in a geometry at any depth, in order. They are owned by the geometry.
[[nodiscard]] std::vector<OGRGeometryH> polygons_within(OGRGeometryH geometry);
/// Same for lines; edges of polygons do not count.
[[nodiscard]] std::vector<OGRGeometryH> lines_within(OGRGeometryH geometry);

/// Returns the polygons of a geometry of any type without heights of vertices. Curves become lines; the
/// result is empty if it contains no polygon.
[[nodiscard]] PolygonFeature polygon_feature_of(OGRGeometryH geometry);

}  // namespace d2b
