#pragma once

#include <string>

#include "core/stop_request.hpp"
#include "core/warnings.hpp"
#include "read/gdal_messages.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// What messages say of the place that is written to.
struct WriteTarget {
    std::string name;  ///< the destination as the user gave it
    std::string
        hidden_folder;  ///< where it is written meanwhile, with a slash; "" where it is written in place
    Warnings* warnings = nullptr;
    StopRequest stop{};
};

/// One step that OGR takes for us. An error that OGR reports is a failure even where the call claims success:
/// what is lost is lost, and drivers report full disks in this way alone.
class OgrCall {
  public:
    explicit OgrCall(const WriteTarget& target) : target_(target), messages_(target.hidden_folder) {}

    /// Passes warnings on. @param doing what was tried, e.g. "creating layer \"buildings\"" @throws
    /// OutputError
    void check(bool succeeded, const std::string& doing);
    [[nodiscard]] bool succeeded() const { return !messages_.failed(); }
    [[nodiscard]] std::string reason() const { return messages_.first_reason(); }
    void pass_warnings();
    /// @throws OutputError: always
    [[noreturn]] void fail(const std::string& doing) const;

  private:
    const WriteTarget& target_;
    GdalMessages messages_;
};

/// What a user can do about a failure of a database, as the end of a sentence that begins with "; "; "" where
/// nothing is known. @param reason GDAL's
[[nodiscard]] std::string advice_for(const std::string& reason);

/// Writes what is pending and closes. @throws OutputError: also where only closing fails
void close_written(const WriteTarget& target, DatasetOwner dataset);

}  // namespace d2b
