#include "read/cutline_polygons.hpp"

#include "core/error.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeference.hpp"
#include "read/polygon_geometry.hpp"
#include "read/ring_projector.hpp"

namespace d2b {

namespace {

DatasetOwner open_vector(const std::string& path, const std::string& name, Context& context) {
    const GdalMessages messages;
    DatasetOwner dataset(GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                    nullptr, nullptr, nullptr));
    if (!dataset)
        throw InputError("The " + name + " cannot be opened: " + messages.reason_for(path) + ".");
    messages.pass_all(context);
    return dataset;
}

/// From the layer's CRS to the DEM's; nothing where they are the same or the layer has none.
TransformOwner transform_between(OGRSpatialReferenceH from, const std::string& name, const DemInfo& info,
                                 Context& context) {
    if (from == nullptr) {
        if (!info.crs_wkt.empty())
            context.warn("The " + name +
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
        throw InputError("The " + name + " cannot be brought into the DEM's coordinate reference system: " +
                         messages.reason() + "; reproject it first.");
    return transform;
}

void add_polygon(OGRGeometryH polygon, RingProjector& projector, std::vector<PixelPolygon>& polygons) {
    PixelPolygon rings;
    for (int i = 0; i < OGR_G_GetGeometryCount(polygon); ++i) {
        const OGRGeometryH line = OGR_G_GetGeometryRef(polygon, i);
        WorldRing ring;
        for (int k = 0; k < OGR_G_GetPointCount(line); ++k)
            ring.push_back({OGR_G_GetX(line, k), OGR_G_GetY(line, k)});
        rings.push_back(projector.project(ring));
    }
    if (!rings.empty())
        polygons.push_back(std::move(rings));
}

}  // namespace

std::vector<PixelPolygon> read_cutline(const std::string& path, const DemInfo& info, Context& context,
                                       const std::string& role) {
    const std::string name = role + " '" + path + "'";
    const DatasetOwner dataset = open_vector(path, name, context);
    const OGRLayerH layer = GDALDatasetGetLayer(dataset.get(), 0);
    if (layer == nullptr)
        throw InputError("The " + name + " has no layer; give a dataset with polygons.");
    const TransformOwner transform = transform_between(OGR_L_GetSpatialRef(layer), name, info, context);
    RingProjector projector(transform.get(), info.transform, name);
    std::vector<PixelPolygon> polygons;
    const GdalMessages messages;
    OGR_L_ResetReading(layer);
    while (const FeatureOwner feature{OGR_L_GetNextFeature(layer)}) {
        const OGRGeometryH geometry = OGR_F_GetGeometryRef(feature.get());
        if (geometry == nullptr || OGR_G_IsEmpty(geometry) != FALSE)
            continue;
        const GeometryOwner straight(OGR_G_GetLinearGeometry(geometry, 0, nullptr));  // arcs become lines
        if (straight)
            for (OGRGeometryH const polygon : polygons_within(straight.get()))
                add_polygon(polygon, projector, polygons);
    }
    if (messages.failed())
        throw InputError("The " + name + " cannot be read: " + messages.reason() + ".");
    messages.pass_warnings(context);
    if (polygons.empty())
        throw InputError("The first layer of the " + name + " (" + OGR_L_GetName(layer) +
                         ") has no polygons; give a dataset with polygons.");
    return polygons;
}

}  // namespace d2b
