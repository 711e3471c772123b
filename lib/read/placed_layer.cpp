#include "read/placed_layer.hpp"

#include <vector>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "read/raster_crs.hpp"
#include "read/vector_dataset.hpp"

namespace d2b {

OGRLayerH layer_of(GDALDatasetH dataset, const PolygonPlace& place, Warnings& warnings) {
    const std::vector<std::string> names = geometry_layers(dataset);
    const std::string all = quoted_names(names);
    if (!place.layer.empty()) {
        const GdalMessages quiet;
        if (const OGRLayerH layer = GDALDatasetGetLayerByName(dataset, place.layer.c_str()))
            return layer;
        throw OptionError("The " + place.name() + " has no layer '" + place.layer + "'; " +
                          (names.empty() ? "it has none with geometries." : "it has " + all + "."));
    }
    if (names.empty())
        throw InputError("The " + place.name() +
                         " has no layer with geometries; give a dataset with polygons.");
    if (names.size() > 1)
        warnings.add("The " + place.name() + " has the layers " + all + "; '" + names.front() +
                     "' is taken, and -" + place.layer_option + " takes another.");
    return GDALDatasetGetLayerByName(dataset, names.front().c_str());
}

TransformOwner transform_to_dem(OGRSpatialReferenceH from, const PolygonPlace& place, const DemInfo& info,
                                Warnings& warnings) {
    if (wkt_of(from).empty()) {
        if (!info.crs_wkt.empty())
            warnings.add("The " + place.name() +
                         " has no coordinate reference system; its coordinates are taken as the DEM's.");
        return nullptr;
    }
    if (info.crs_wkt.empty())
        throw InputError("The " + place.name() + " has a coordinate reference system and '" + info.name +
                         "' has none; give the DEM's with -a_srs.");
    const GdalMessages messages;
    const CrsOwner to = horizontal_crs(info.crs_wkt);
    if (OSRIsSame(from, to.get()) != FALSE)
        return nullptr;
    TransformOwner transform(OCTNewCoordinateTransformation(from, to.get()));
    if (!transform)
        throw InputError("The " + place.name() +
                         " cannot be converted to the DEM's coordinate reference system: " +
                         messages.reason() + "; reproject it first.");
    return transform;
}

}  // namespace d2b
