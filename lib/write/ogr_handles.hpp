#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <cpl_string.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

namespace d2b {

/// Owners of OGR's C handles: the function that releases one is part of its type.
template <typename Handle, auto release>
struct HandleDeleter {
    void operator()(std::remove_pointer_t<Handle>* handle) const { release(handle); }
};
template <typename Handle, auto release>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, HandleDeleter<Handle, release>>;

using DatasetHandle = Owned<GDALDatasetH, GDALClose>;
using FeatureHandle = Owned<OGRFeatureH, OGR_F_Destroy>;
using FieldHandle = Owned<OGRFieldDefnH, OGR_Fld_Destroy>;
using SrsHandle = Owned<OGRSpatialReferenceH, OSRRelease>;

/// A NULL-terminated list of NAME=VALUE, as GDAL takes them.
class NameValueList {
  public:
    NameValueList() = default;
    explicit NameValueList(const std::vector<std::string>& items) {
        for (const auto& item : items)
            list_.AddString(item.c_str());
    }
    [[nodiscard]] bool has(const char* name) const { return list_.FetchNameValue(name) != nullptr; }
    void set(const char* name, const std::string& value) { list_.SetNameValue(name, value.c_str()); }
    [[nodiscard]] CSLConstList get() const { return list_.List(); }

  private:
    CPLStringList list_;
};

}  // namespace d2b
