#pragma once

#include <string>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "read/gdal_handles.hpp"

namespace d2b {

/// Source of polygons or lines.
struct PolygonPlace {
    std::string role;          ///< name in messages: "cutline", "mask", "parcels"
    std::string layer_option;  ///< option that names the layer
    std::string path{};        ///< any vector dataset that GDAL opens
    std::string layer{};       ///< "": first layer with geometries, with a warning if there are several

    [[nodiscard]] std::string name() const { return role + " '" + path + "'"; }
};

/// Returns the layer that the source names. @throws InputError if there is no layer with geometries. @throws
/// OptionError if the named one does not exist
[[nodiscard]] OGRLayerH layer_of(GDALDatasetH dataset, const PolygonPlace& place, Warnings& warnings);

/// Returns the transformation from the CRS of the layer to that of the DEM, or null if they are the same or
/// the layer has none.
/// @throws InputError: a CRS although the DEM has none, or no operation between the two
[[nodiscard]] TransformOwner transform_to_dem(OGRSpatialReferenceH from, const PolygonPlace& place,
                                              const DemInfo& info, Warnings& warnings);

}  // namespace d2b
