#pragma once

#include <string>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "read/gdal_handles.hpp"

namespace d2b {

/// Where polygons or lines are read from.
struct PolygonPlace {
    std::string role;          ///< what messages call it: "cutline", "mask", "parcels"
    std::string layer_option;  ///< the option that names its layer
    std::string path{};        ///< any vector dataset that GDAL opens
    std::string layer{};       ///< "": the first that has geometries, with a warning where there are several

    [[nodiscard]] std::string name() const { return role + " '" + path + "'"; }
};

/// @throws InputError there is no layer with geometries. @throws OptionError the named one is not there
[[nodiscard]] OGRLayerH layer_of(GDALDatasetH dataset, const PolygonPlace& place, Warnings& warnings);

/// From the layer's CRS to the DEM's; nothing where they are the same or the layer has none.
/// @throws InputError a CRS where the DEM has none, or no operation between the two
[[nodiscard]] TransformOwner transform_to_dem(OGRSpatialReferenceH from, const PolygonPlace& place,
                                              const DemInfo& info, Warnings& warnings);

}  // namespace d2b
