#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <cpl_string.h>

#include "core/utf8_text.hpp"
#include "read/gdal_handles.hpp"

namespace d2b {

using FieldOwner = GdalOwner<OGRFieldDefnH, OGR_Fld_Destroy>;

/// True if the value of a format option is a file or folder name, such as TEMPORARY_DIR.
[[nodiscard]] inline bool names_a_file(std::string_view option) {
    const std::string name(option.substr(0, option.find('=')));
    constexpr std::array endings{"DIR", "FILE", "FILENAME", "PATH"};
    return std::ranges::any_of(endings, [&](std::string_view ending) {
        return name.size() >= ending.size() &&
               EQUAL(name.c_str() + name.size() - ending.size(), ending.data());
    });
}

/// NULL-terminated list of NAME=VALUE pairs for GDAL. Values are converted to UTF-8, because they end up in
/// results; file names keep their bytes.
class NameValueList {
  public:
    NameValueList() = default;
    explicit NameValueList(const std::vector<std::string>& items) {
        for (const auto& item : items)
            list_.AddString((names_a_file(item) ? item : utf8_text(item)).c_str());
    }
    [[nodiscard]] bool has(const char* name) const { return list_.FetchNameValue(name) != nullptr; }
    void set(const char* name, const std::string& value) { list_.SetNameValue(name, value.c_str()); }
    [[nodiscard]] CSLConstList get() const { return list_.List(); }

  private:
    CPLStringList list_;
};

}  // namespace d2b
