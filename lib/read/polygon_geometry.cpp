#include "read/polygon_geometry.hpp"

#include <cstddef>
#include <utility>

#include "read/gdal_handles.hpp"

namespace d2b {
namespace {

WorldRing ring_of(OGRGeometryH line, bool& open) {
    const int count = OGR_G_GetPointCount(line);
    WorldRing ring(static_cast<std::size_t>(count));
    constexpr int stride = sizeof(Position);
    if (count > 0)
        OGR_G_GetPoints(line, &ring[0].x, stride, &ring[0].y, stride, nullptr, 0);
    if (ring.size() > 1 && ring.front() == ring.back())
        ring.pop_back();
    else if (!ring.empty())
        open = true;
    return ring;
}

void add_polygon(OGRGeometryH polygon, PolygonFeature& feature) {
    WorldPolygon result;
    for (int i = 0; i < OGR_G_GetGeometryCount(polygon); ++i) {
        WorldRing ring = ring_of(OGR_G_GetGeometryRef(polygon, i), feature.open_ring);
        if (i == 0)
            result.exterior = std::move(ring);
        else if (!ring.empty())
            result.interiors.push_back(std::move(ring));
    }
    if (!result.exterior.empty())
        feature.polygons.push_back(std::move(result));
}

/// Returns the parts of a wanted type at any depth of nested collections.
template <typename IsWanted>
std::vector<OGRGeometryH> parts_within(OGRGeometryH geometry, const IsWanted& is_wanted) {
    std::vector<OGRGeometryH> parts;
    std::vector<OGRGeometryH> open{geometry};  // no recursion, because files decide the depth of nesting
    while (!open.empty()) {
        OGRGeometryH const next = open.back();
        open.pop_back();
        const OGRwkbGeometryType type = OGR_GT_Flatten(OGR_G_GetGeometryType(next));
        if (is_wanted(type))
            parts.push_back(next);
        else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != FALSE ||
                 OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface) != FALSE)
            for (int i = OGR_G_GetGeometryCount(next); i-- > 0;)
                open.push_back(OGR_G_GetGeometryRef(next, i));
    }
    return parts;
}

}  // namespace

std::vector<OGRGeometryH> polygons_within(OGRGeometryH geometry) {
    return parts_within(geometry,
                        [](OGRwkbGeometryType type) { return type == wkbPolygon || type == wkbTriangle; });
}

std::vector<OGRGeometryH> lines_within(OGRGeometryH geometry) {
    return parts_within(geometry, [](OGRwkbGeometryType type) { return type == wkbLineString; });
}

PolygonFeature polygon_feature_of(OGRGeometryH geometry) {
    PolygonFeature feature;
    const GeometryOwner straight(OGR_G_GetLinearGeometry(geometry, 0, nullptr));
    if (straight)
        for (OGRGeometryH const polygon : polygons_within(straight.get()))
            add_polygon(polygon, feature);
    return feature;
}

}  // namespace d2b
