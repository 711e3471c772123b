#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <cpl_conv.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

namespace d2b::reading {

/// Owners of GDAL's C handles.
template <typename Handle, auto release>
struct GdalRelease {
    void operator()(Handle handle) const { release(handle); }
};
template <typename Handle, auto release>
using GdalOwner = std::unique_ptr<std::remove_pointer_t<Handle>, GdalRelease<Handle, release>>;

/// Keeps GDAL from writing an .aux.xml next to datasets that are opened, written or closed during its
/// lifetime, unless the user has set the option.
class NoSidecar {
    CPLConfigOptionSetter option_{"GDAL_PAM_ENABLED", "NO", true};
};

inline void close_dataset(GDALDatasetH dataset) {
    // GDAL 3.10 writes the metadata of a GeoPackage to an .aux.xml when it is closed after being read.
    const NoSidecar no_sidecar;
    GDALClose(dataset);  // returns CPLErr from GDAL 3.7 on
}

using DatasetOwner = GdalOwner<GDALDatasetH, close_dataset>;
using GeometryOwner = GdalOwner<OGRGeometryH, OGR_G_DestroyGeometry>;
using FeatureOwner = GdalOwner<OGRFeatureH, OGR_F_Destroy>;
using CrsOwner = GdalOwner<OGRSpatialReferenceH, OSRRelease>;
using TransformOwner = GdalOwner<OGRCoordinateTransformationH, OCTDestroyCoordinateTransformation>;

/// List of strings as GDAL's C functions take it. Views the strings, which must outlive it.
class StringList {
  public:
    explicit StringList(const std::vector<std::string>& strings) {
        for (const std::string& text : strings)
            pointers_.push_back(text.c_str());
        pointers_.push_back(nullptr);
    }
    /// Returns nullptr if the list is empty, because GDAL takes an empty list of drivers for "none of them".
    [[nodiscard]] const char* const* get() const {
        return pointers_.size() == 1 ? nullptr : pointers_.data();
    }

  private:
    std::vector<const char*> pointers_;
};

}  // namespace d2b::reading
