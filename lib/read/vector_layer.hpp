#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <ogr_api.h>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "read/gdal_handles.hpp"
#include "read/polygon_layer.hpp"

namespace d2b::reading {

/// Returns the polygons and triangles in a geometry at any depth, in order. They are owned by the geometry.
[[nodiscard]] std::vector<OGRGeometryH> polygons_within(OGRGeometryH geometry);
/// Same for lines; edges of polygons do not count.
[[nodiscard]] std::vector<OGRGeometryH> lines_within(OGRGeometryH geometry);
/// Same for points that are not empty; vertices do not count.
[[nodiscard]] std::vector<OGRGeometryH> points_within(OGRGeometryH geometry);

/// Returns true if a geometry is valid, or if all polygons of a surface are, of which GEOS knows none.
[[nodiscard]] bool is_valid(OGRGeometryH geometry);

/// Returns the vertices of a line or ring, without heights.
[[nodiscard]] WorldRing points_of(OGRGeometryH line);
/// Returns the vertices of all rings of a polygon, the exterior first.
[[nodiscard]] std::vector<WorldRing> rings_of(OGRGeometryH polygon);

/// Returns the polygons of a geometry of any type without heights of vertices. Curves become lines; the
/// result is empty if it contains no polygon. @param elevations gets the heights, ring by ring in the order
/// of the vertices, if it is not null
[[nodiscard]] PolygonFeature polygon_feature_of(OGRGeometryH geometry,
                                                std::vector<double>* elevations = nullptr);

/// Opens a dataset with polygons for a comparison. @throws InputError
[[nodiscard]] DatasetOwner open_polygons(const std::string& path, Warnings& warnings);

/// Names of layers with geometries, in order.
[[nodiscard]] std::vector<std::string> geometry_layers(GDALDatasetH dataset);

/// Returns the layer that `choice` names. @throws InputError if there is no layer with geometries. @throws
/// OptionError if the requested one does not exist
[[nodiscard]] OGRLayerH pick_layer(GDALDatasetH dataset, const LayerChoice& choice);

/// Calls visit(feature, geometry) for all features of a layer whose geometry is not empty.
/// @param what "The layer 'x' of 'y'", for messages @throws InputError if it cannot be read to its end
void for_each_geometry(OGRLayerH layer, const std::string& what, Warnings& warnings,
                       const std::function<void(OGRFeatureH, OGRGeometryH)>& visit);

/// Same for a comparison: warns of the features for which add(feature, geometry) returns false, because they
/// have no polygon.
void for_each_polygon_feature(OGRLayerH layer, const std::string& dataset, Warnings& warnings,
                              const std::function<bool(OGRFeatureH, OGRGeometryH)>& add);

/// Lists the fields of a layer for messages: "its fields are 'a' and 'b'."
[[nodiscard]] std::string field_list(OGRLayerH layer);
/// Names the fields that a layer has instead. @throws OptionError
[[noreturn]] void refuse_missing_field(OGRLayerH layer, const std::string& dataset, const std::string& field);

/// Formats "'a', 'b' and 'c'", shortened if there are very many; "" for none.
[[nodiscard]] std::string quoted_names(std::span<const std::string> names);

/// Source of polygons or lines.
struct PolygonSource {
    std::string role;          ///< name in messages: "cutline", "mask", "parcels"
    std::string layer_option;  ///< option that names the layer
    std::string path{};        ///< any vector dataset that GDAL opens
    std::string layer{};       ///< "": first layer with geometries, with a warning if there are several

    [[nodiscard]] std::string name() const { return role + " '" + path + "'"; }
};

/// Opens a source. @throws InputError
[[nodiscard]] DatasetOwner open_source(const PolygonSource& source, Warnings& warnings);

/// Returns the layer that the source names. @throws InputError if there is no layer with geometries. @throws
/// OptionError if the named one does not exist
[[nodiscard]] OGRLayerH layer_of(GDALDatasetH dataset, const PolygonSource& source, Warnings& warnings);

/// Returns the name of the layer that layer_of() takes if an option names this one, or none; "" if there is
/// none, which is reported when it is read.
[[nodiscard]] std::string layer_name(const std::string& path, const std::string& layer);

/// Returns the transformation from the CRS of the layer to that of the DEM, or null if they are the same or
/// the layer has none.
/// @throws InputError: a CRS although the DEM has none, or no operation between the two
[[nodiscard]] TransformOwner transform_to_dem(OGRSpatialReferenceH from, const PolygonSource& source,
                                              const DemInfo& info, Warnings& warnings);

}  // namespace d2b::reading
