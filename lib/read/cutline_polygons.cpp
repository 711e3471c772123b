#include "read/cutline_polygons.hpp"

#include <algorithm>

#include "dem2buildings/error.hpp"
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

OGRLayerH layer_of(GDALDatasetH dataset, const PolygonPlace& place, const std::string& name,
                   Warnings& warnings) {
    const std::vector<std::string> names = geometry_layers(dataset);
    const std::string all = quoted_names(names);
    if (!place.layer.empty()) {
        const GdalMessages quiet;
        if (const OGRLayerH layer = GDALDatasetGetLayerByName(dataset, place.layer.c_str()))
            return layer;
        throw OptionError("The " + name + " has no layer '" + place.layer + "'; " +
                          (names.empty() ? "it has none with geometries." : "it has " + all + "."));
    }
    if (names.empty())
        throw InputError("The " + name + " has no layer with geometries; give a dataset with polygons.");
    if (names.size() > 1)
        warnings.add("The " + name + " has the layers " + all + "; '" + names.front() + "' is taken, and -" +
                     place.role + "_layer takes another.");
    return GDALDatasetGetLayerByName(dataset, names.front().c_str());
}

/// From the layer's CRS to the DEM's; nothing where they are the same or the layer has none.
TransformOwner transform_between(OGRSpatialReferenceH from, const std::string& name, const DemInfo& info,
                                 Warnings& warnings) {
    if (from == nullptr) {
        if (!info.crs_wkt.empty())
            warnings.add("The " + name +
                         " has no coordinate reference system; its coordinates are taken as the DEM's.");
        return nullptr;
    }
    if (info.crs_wkt.empty())
        throw InputError("The " + name + " has a coordinate reference system and '" + info.name +
                         "' has none; give the DEM's with -a_srs.");
    const GdalMessages messages;
    const CrsOwner to = horizontal_crs(info.crs_wkt);
    if (OSRIsSame(from, to.get()) != FALSE)
        return nullptr;
    TransformOwner transform(OCTNewCoordinateTransformation(from, to.get()));
    if (!transform)
        throw InputError("The " + name + " cannot be converted to the DEM's coordinate reference system: " +
                         messages.reason() + "; reproject it first.");
    return transform;
}

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

/// What of the rings lies in a box.
std::vector<WorldRing> clipped(const std::vector<WorldRing>& rings, const ClipBox& box) {
    std::vector<WorldRing> kept;
    for (const WorldRing& ring : rings)
        if (WorldRing part = clipped(ring, box); !part.empty())
            kept.push_back(std::move(part));
    return kept;
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

std::vector<PixelPolygon> read_cutline(const PolygonPlace& place, const DemInfo& info, Warnings& warnings) {
    const std::string name = place.role + " '" + place.path + "'";
    const DatasetOwner dataset =
        open_vector_dataset(place.path, "The " + name + " cannot be opened", warnings);
    const OGRLayerH layer = layer_of(dataset.get(), place, name, warnings);
    const TransformOwner transform = transform_between(OGR_L_GetSpatialRef(layer), name, info, warnings);
    RingProjector projector(transform.get(), info.transform, name);
    Surroundings around;
    if (transform)
        around = surroundings(OGR_L_GetSpatialRef(layer), horizontal_crs(info.crs_wkt).get(), info);
    std::vector<PixelPolygon> polygons;
    bool any = false;
    for_each_geometry(layer, "The " + name, warnings, [&](OGRFeatureH, OGRGeometryH geometry) {
        const GeometryOwner straight(OGR_G_GetLinearGeometry(geometry, 0, nullptr));  // arcs become lines
        if (!straight)
            return;
        for (OGRGeometryH const polygon : polygons_within(straight.get())) {
            const std::vector<WorldRing> rings = rings_of(polygon);
            any = any || !rings.empty();
            add_polygon(rings, projector, around, polygons);
        }
    });
    if (!any)
        throw InputError("The layer '" + std::string(OGR_L_GetName(layer)) + "' of the " + name +
                         " has no polygons; give one that has, for example with -" + place.role + "_layer.");
    return polygons;
}

}  // namespace d2b
