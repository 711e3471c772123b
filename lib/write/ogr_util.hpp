#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <cpl_string.h>

#include "core/stop_token.hpp"
#include "core/text.hpp"
#include "core/warnings.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"

namespace d2b::writing {

using FieldOwner = reading::GdalOwner<OGRFieldDefnH, OGR_Fld_Destroy>;

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

class IoErrorMonitor;

/// Destination as named in messages.
struct WriteTarget {
    std::string name;           ///< user input
    std::string hidden_folder;  ///< temporary folder with trailing slash; "" if written in place
    Warnings* warnings = nullptr;
    StopToken stop{};
    const IoErrorMonitor* monitor = nullptr;  ///< reports failed writes that the driver does not
};

/// Guards one call of OGR. Treats each reported error as a failure, even if the call returns success, because
/// drivers report a full disk only in this way.
class OgrCall {
  public:
    explicit OgrCall(const WriteTarget& target) : target_(target), messages_(target.hidden_folder) {}

    /// Forwards warnings. @param doing the attempted step, e.g. "creating layer \"buildings\""
    /// @throws OutputError on failure
    void check(bool succeeded, const std::string& doing);
    [[nodiscard]] bool succeeded() const { return !messages_.failed(); }
    [[nodiscard]] std::string reason() const { return messages_.first_reason(); }
    void pass_warnings();
    /// @throws OutputError always
    [[noreturn]] void fail(const std::string& doing) const;

  private:
    const WriteTarget& target_;
    reading::GdalMessages messages_;
};

/// Returns advice about an error of a database, as the end of a sentence that begins with "; "; "" if there
/// is none. @param reason message of GDAL
[[nodiscard]] std::string advice_for(const std::string& reason);

/// Flushes and closes. @throws OutputError, also if only closing fails
void close_written(const WriteTarget& target, reading::DatasetOwner dataset);

}  // namespace d2b::writing
