#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/warnings.hpp"

namespace d2b::reading {

/// Collects GDAL's messages in this thread during its lifetime, so that nothing is printed to stderr and our
/// exceptions carry GDAL's reason. Debug messages pass through because they appear only on request. Scopes
/// may nest. They must end in reverse order, in the thread that began them.
class GdalMessages {
  public:
    /// @param hidden name of a file or folder that users do not know @param shown its replacement in messages
    explicit GdalMessages(std::string hidden = "", std::string shown = "");
    GdalMessages(const GdalMessages&) = delete;
    GdalMessages& operator=(const GdalMessages&) = delete;
    ~GdalMessages();

    /// Returns true if GDAL has reported an error, even if the call claimed to have succeeded.
    [[nodiscard]] bool failed() const { return !last_error_.empty(); }
    /// GDAL's last error: one line without a full stop; "GDAL gives no reason" if there is none.
    [[nodiscard]] std::string reason() const;
    /// GDAL's first error. Later errors are often only its consequences.
    [[nodiscard]] std::string first_reason() const;
    /// Reason without the name of the file, because our own sentence has already given it.
    [[nodiscard]] std::string reason_for(const std::string& path) const;
    /// Distinct warnings in order, one line each.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

    /// Passes GDAL's warnings on, as quotes.
    void pass_warnings(Warnings& warnings) const;
    /// Same as pass_warnings(), and errors as well: for calls that have succeeded nevertheless.
    void pass_all(Warnings& warnings) const;

    /// Stores one message; called by GDAL's error handler.
    void add(bool is_error, const char* text);

  private:
    std::string first_error_;
    std::string hidden_;
    std::string shown_;
    std::string last_error_;
    std::vector<std::string> errors_;
    std::vector<std::string> warnings_;
};

/// Formats a GDAL message as one line: collapses white space and control characters to single blanks, removes
/// a trailing full stop, and truncates long text.
[[nodiscard]] std::string one_line(std::string_view text);

}  // namespace d2b::reading
