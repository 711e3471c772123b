#pragma once

#include <string>
#include <vector>

#include <cpl_string.h>

#include "read/gdal_handles.hpp"

namespace d2b {

using FieldOwner = GdalOwner<OGRFieldDefnH, OGR_Fld_Destroy>;

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
