#pragma once

#include <string>

#include "core/stop_request.hpp"
#include "core/warnings.hpp"
#include "read/gdal_messages.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// Destination as named in messages.
struct WriteTarget {
    std::string name;           ///< user input
    std::string hidden_folder;  ///< temporary folder with trailing slash; "" if written in place
    Warnings* warnings = nullptr;
    StopRequest stop{};
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
    GdalMessages messages_;
};

/// Returns advice about an error of a database, as the end of a sentence that begins with "; "; "" if there
/// is none. @param reason message of GDAL
[[nodiscard]] std::string advice_for(const std::string& reason);

/// Flushes and closes. @throws OutputError, also if only closing fails
void close_written(const WriteTarget& target, DatasetOwner dataset);

}  // namespace d2b
