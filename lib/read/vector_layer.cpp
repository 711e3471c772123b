#include "read/vector_layer.hpp"

#include <algorithm>
#include <utility>

#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeferencing.hpp"

namespace d2b::reading {
namespace {

/// @param elevations those of the vertices are added, if it is not null
WorldRing ring_of(OGRGeometryH line, bool& open, std::vector<double>* elevations) {
    WorldRing ring = points_of(line);
    if (ring.size() > 1 && ring.front() == ring.back())
        ring.pop_back();
    else if (!ring.empty())
        open = true;
    for (int i = 0; elevations != nullptr && i < static_cast<int>(ring.size()); ++i)
        elevations->push_back(OGR_G_GetZ(line, i));
    return ring;
}

void add_polygon(OGRGeometryH polygon, PolygonFeature& feature, std::vector<double>* elevations) {
    WorldPolygon result;
    for (int i = 0; i < OGR_G_GetGeometryCount(polygon); ++i) {
        WorldRing ring = ring_of(OGR_G_GetGeometryRef(polygon, i), feature.open_ring, elevations);
        if (i == 0)
            result.exterior = std::move(ring);
        else if (!ring.empty())
            result.interiors.push_back(std::move(ring));
    }
    if (!result.exterior.empty())
        feature.polygons.push_back(std::move(result));
}

/// @param complaint "'x' cannot be opened", before GDAL's reason
DatasetOwner open_vector_dataset(const std::string& path, const std::string& complaint, Warnings& warnings) {
    const GdalMessages messages;
    DatasetOwner dataset = open_guarded(path, GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR);
    if (!dataset)
        throw InputError(complaint + ": " + messages.reason_for(path) + ".");
    messages.pass_all(warnings);
    return dataset;
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

std::vector<OGRGeometryH> points_within(OGRGeometryH geometry) {
    std::vector<OGRGeometryH> points =
        parts_within(geometry, [](OGRwkbGeometryType type) { return type == wkbPoint; });
    std::erase_if(points, [](OGRGeometryH point) { return OGR_G_IsEmpty(point) != FALSE; });
    return points;
}

bool is_valid(OGRGeometryH geometry) {
    const GdalMessages quiet;  // suppresses GDAL's explanation
    const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
    if (type == wkbPolyhedralSurface || type == wkbTIN)
        return std::ranges::all_of(polygons_within(geometry), is_valid);
    // A triangle is taken as the polygon that it is.
    const GeometryOwner polygon(type == wkbTriangle ? OGR_G_ForceToPolygon(OGR_G_Clone(geometry)) : nullptr);
    return OGR_G_IsValid(polygon ? polygon.get() : geometry) != FALSE;
}

WorldRing points_of(OGRGeometryH line) {
    WorldRing points(static_cast<std::size_t>(OGR_G_GetPointCount(line)));
    constexpr int stride = sizeof(Position);
    if (!points.empty())
        OGR_G_GetPoints(line, &points[0].x, stride, &points[0].y, stride, nullptr, 0);
    return points;
}

std::vector<WorldRing> rings_of(OGRGeometryH polygon) {
    const int count = OGR_G_GetGeometryCount(polygon);
    std::vector<WorldRing> rings;
    rings.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        rings.push_back(points_of(OGR_G_GetGeometryRef(polygon, i)));
    return rings;
}

PolygonFeature polygon_feature_of(OGRGeometryH geometry, std::vector<double>* elevations) {
    PolygonFeature feature;
    const GeometryOwner straight(OGR_G_GetLinearGeometry(geometry, 0, nullptr));
    if (straight)
        for (OGRGeometryH const polygon : polygons_within(straight.get()))
            add_polygon(polygon, feature, elevations);
    return feature;
}

DatasetOwner open_polygons(const std::string& path, Warnings& warnings) {
    return open_vector_dataset(path, "'" + path + "' cannot be opened as a vector dataset", warnings);
}

DatasetOwner open_source(const PolygonSource& source, Warnings& warnings) {
    return open_vector_dataset(source.path, "The " + source.name() + " cannot be opened", warnings);
}

std::vector<std::string> geometry_layers(GDALDatasetH dataset) {
    std::vector<std::string> names;
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset); ++i) {
        const OGRLayerH layer = GDALDatasetGetLayer(dataset, i);
        if (OGR_L_GetGeomType(layer) != wkbNone)
            names.emplace_back(OGR_L_GetName(layer));
    }
    return names;
}

OGRLayerH pick_layer(GDALDatasetH dataset, const LayerChoice& choice) {
    const std::vector<std::string> names = geometry_layers(dataset);
    if (names.empty())
        throw InputError("'" + choice.dataset +
                         "' has no layer with geometries; give a dataset with polygons.");
    if (!choice.layer.empty()) {
        if (const OGRLayerH layer = GDALDatasetGetLayerByName(dataset, choice.layer.c_str()))
            return layer;
        throw OptionError("'" + choice.dataset + "' has no layer '" + choice.layer + "'; it has " +
                          quoted_names(names) + ".");
    }
    for (const std::string& name : choice.defaults)
        if (const OGRLayerH layer = GDALDatasetGetLayerByName(dataset, name.c_str()))
            return layer;
    return GDALDatasetGetLayerByName(dataset, names.front().c_str());
}

void for_each_geometry(OGRLayerH layer, const std::string& what, Warnings& warnings,
                       const std::function<void(OGRFeatureH, OGRGeometryH)>& visit) {
    const GdalMessages messages;
    OGR_L_ResetReading(layer);
    while (const FeatureOwner feature{OGR_L_GetNextFeature(layer)})
        if (OGRGeometryH const geometry = OGR_F_GetGeometryRef(feature.get());
            geometry != nullptr && OGR_G_IsEmpty(geometry) == FALSE)
            visit(feature.get(), geometry);
    if (messages.failed())
        throw InputError(what + " cannot be read: " + messages.reason() + ".");
    messages.pass_warnings(warnings);
}

void for_each_polygon_feature(OGRLayerH layer, const std::string& dataset, Warnings& warnings,
                              const std::function<bool(OGRFeatureH, OGRGeometryH)>& add) {
    const std::string name = "layer '" + std::string(OGR_L_GetName(layer)) + "' of '" + dataset + "'";
    std::size_t others = 0;
    for_each_geometry(layer, "The " + name, warnings, [&](OGRFeatureH feature, OGRGeometryH geometry) {
        others += add(feature, geometry) ? 0U : 1U;
    });
    if (others > 0)
        warnings.add(std::to_string(others) + (others == 1 ? " feature" : " features") + " of the " + name +
                     (others == 1 ? " has" : " have") + " no polygon and " + (others == 1 ? "is" : "are") +
                     " left out.");
}

std::string field_list(OGRLayerH layer) {
    const OGRFeatureDefnH schema = OGR_L_GetLayerDefn(layer);
    const int count = OGR_FD_GetFieldCount(schema);
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        names.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(schema, i)));
    return names.empty() ? "it has no fields at all." : "its fields are " + quoted_names(names) + ".";
}

void refuse_missing_field(OGRLayerH layer, const std::string& dataset, const std::string& field) {
    throw OptionError("The layer '" + std::string(OGR_L_GetName(layer)) + "' of '" + dataset +
                      "' has no field '" + field + "'; " + field_list(layer));
}

std::string quoted_names(std::span<const std::string> names) {
    constexpr std::size_t most = 20;
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < most; ++i) {
        const bool last = i + 1 == names.size();
        text += (i == 0 ? "'" : last ? " and '" : ", '") + names[i] + "'";
    }
    return names.size() > most ? text + " and others" : text;
}

OGRLayerH layer_of(GDALDatasetH dataset, const PolygonSource& source, Warnings& warnings) {
    const std::vector<std::string> names = geometry_layers(dataset);
    const std::string all = quoted_names(names);
    if (!source.layer.empty()) {
        const GdalMessages quiet;
        if (const OGRLayerH layer = GDALDatasetGetLayerByName(dataset, source.layer.c_str()))
            return layer;
        throw OptionError("The " + source.name() + " has no layer '" + source.layer + "'; " +
                          (names.empty() ? "it has none with geometries." : "it has " + all + "."));
    }
    if (names.empty())
        throw InputError("The " + source.name() +
                         " has no layer with geometries; give a dataset with polygons.");
    if (names.size() > 1)
        warnings.add("The " + source.name() + " has the layers " + all + "; '" + names.front() +
                     "' is taken, and -" + source.layer_option + " takes another.");
    return GDALDatasetGetLayerByName(dataset, names.front().c_str());
}

std::string layer_name(const std::string& path, const std::string& layer) {
    if (!layer.empty())
        return layer;
    const NetworkGuard gate(path);
    const GdalMessages quiet;
    const DatasetOwner dataset = open_guarded(path, GDAL_OF_VECTOR | GDAL_OF_READONLY);
    const std::vector<std::string> names =
        dataset ? geometry_layers(dataset.get()) : std::vector<std::string>();
    return names.empty() ? "" : names.front();
}

TransformOwner transform_to_dem(OGRSpatialReferenceH from, const PolygonSource& source, const DemInfo& info,
                                Warnings& warnings) {
    if (wkt_of(from).empty()) {
        if (!info.crs_wkt.empty())
            warnings.add("The " + source.name() +
                         " has no coordinate reference system; its coordinates are taken as the DEM's.");
        return nullptr;
    }
    if (info.crs_wkt.empty())
        throw InputError("The " + source.name() + " has a coordinate reference system and '" + info.name +
                         "' has none; give the DEM's with -a_srs.");
    const GdalMessages messages;
    const CrsOwner to = horizontal_crs(info.crs_wkt);
    if (OSRIsSame(from, to.get()) != FALSE)
        return nullptr;
    TransformOwner transform(OCTNewCoordinateTransformation(from, to.get()));
    if (!transform)
        throw InputError("The " + source.name() +
                         " cannot be converted to the DEM's coordinate reference system: " +
                         messages.reason() + "; reproject it first.");
    return transform;
}

}  // namespace d2b::reading
