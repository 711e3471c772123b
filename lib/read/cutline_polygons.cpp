#include "read/cutline_polygons.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"
#include "read/polygon_geometry.hpp"
#include "read/raster_crs.hpp"
#include "read/ring_clip.hpp"
#include "read/ring_projector.hpp"
#include "read/surroundings.hpp"
#include "read/vector_dataset.hpp"

namespace d2b {

namespace {

std::vector<WorldRing> rings_of(OGRGeometryH polygon) {
    std::vector<WorldRing> rings;
    for (int i = 0; i < OGR_G_GetGeometryCount(polygon); ++i) {
        const OGRGeometryH line = OGR_G_GetGeometryRef(polygon, i);
        WorldRing& ring = rings.emplace_back();
        for (int k = 0; k < OGR_G_GetPointCount(line); ++k)
            ring.push_back({OGR_G_GetX(line, k), OGR_G_GetY(line, k)});
    }
    return rings;
}

/// Clips rings to a box and drops empty ones.
std::vector<WorldRing> clipped(const std::vector<WorldRing>& rings, const ClipBox& box) {
    std::vector<WorldRing> kept;
    for (const WorldRing& ring : rings)
        if (WorldRing part = clipped(ring, box); !part.empty())
            kept.push_back(std::move(part));
    return kept;
}

bool is_valid(OGRGeometryH polygon) {
    const GdalMessages quiet;  // suppresses GDAL's explanation
    return OGR_G_IsValid(polygon) != FALSE;
}

void add_polygon(const std::vector<WorldRing>& rings, RingProjector& projector, const Surroundings& around,
                 std::vector<PixelPolygon>& polygons) {
    const bool on_earth =
        std::ranges::all_of(rings, [&](const WorldRing& ring) { return around.earth.holds(ring); });
    const std::vector<ClipBox> everywhere(1);
    for (const ClipBox& box : around.boxes.empty() || !on_earth ? everywhere : around.boxes) {
        PixelPolygon pixels;
        for (const WorldRing& ring : clipped(rings, box))
            pixels.push_back(projector.project(ring));
        if (!pixels.empty())
            polygons.push_back(std::move(pixels));
    }
}

}  // namespace

ClipBox box_of(const PixelPolygon& polygon) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    ClipBox box{inf, inf, -inf, -inf};
    for (const WorldRing& ring : polygon)
        for (const Position& p : ring)
            box = {std::min(box.left, p.x), std::min(box.bottom, p.y), std::max(box.right, p.x),
                   std::max(box.top, p.y)};
    return box;
}

bool meets(const ClipBox& box, const Window& w) {
    return box.right > w.col && box.left < static_cast<double>(w.col) + w.cols && box.top > w.row &&
           box.bottom < static_cast<double>(w.row) + w.rows;
}

std::vector<PixelPolygon> read_cutline(const PolygonPlace& place, const DemInfo& info, Warnings& warnings) {
    const std::string name = place.name();
    const FetchGate gate(place.path);
    const DatasetOwner dataset =
        open_vector_dataset(place.path, "The " + name + " cannot be opened", warnings);
    const OGRLayerH layer = layer_of(dataset.get(), place, warnings);
    const TransformOwner transform = transform_to_dem(OGR_L_GetSpatialRef(layer), place, info, warnings);
    RingProjector projector(transform.get(), info.transform, name);
    Surroundings around;
    if (transform)
        around = surroundings(OGR_L_GetSpatialRef(layer), horizontal_crs(info.crs_wkt).get(), info);
    std::vector<PixelPolygon> polygons;
    bool any = false;
    std::size_t invalid = 0;
    for_each_geometry(layer, "The " + name, warnings, [&](OGRFeatureH, OGRGeometryH geometry) {
        const GeometryOwner straight(OGR_G_GetLinearGeometry(geometry, 0, nullptr));  // arcs become lines
        if (!straight)
            return;
        for (OGRGeometryH const polygon : polygons_within(straight.get())) {
            const std::vector<WorldRing> rings = rings_of(polygon);
            any = any || !rings.empty();
            const std::size_t before = polygons.size();
            add_polygon(rings, projector, around, polygons);
            const bool is_used =
                std::any_of(polygons.begin() + static_cast<std::ptrdiff_t>(before), polygons.end(),
                            [&](const PixelPolygon& pixels) { return meets(box_of(pixels), info.window); });
            OGR_G_CloseRings(polygon);
            if (is_used && !is_valid(polygon))
                ++invalid;
        }
    });
    if (invalid == 1)
        warnings.add("A polygon of the " + name +
                     " is not valid, and is taken for what an odd number of its rings encloses; make it "
                     "valid, for example by ogr2ogr -makevalid.");
    else if (invalid > 1)
        warnings.add(std::to_string(invalid) + " polygons of the " + name +
                     " are not valid, and are taken for what an odd number of their rings encloses; make "
                     "them valid, for example by ogr2ogr -makevalid.");
    if (!any)
        throw InputError("The layer '" + std::string(OGR_L_GetName(layer)) + "' of the " + name +
                         " has no polygons; give one that has, for example with -" + place.layer_option +
                         ".");
    return polygons;
}

}  // namespace d2b
