#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/warnings.hpp"

namespace d2b {

/// Collects what GDAL says in this thread for as long as it lives, so that nothing reaches stderr by itself
/// and our exceptions carry GDAL's own reason. Debug messages pass through: only who asks for them gets them.
/// Scopes may nest; they must end in the reverse order, in the thread that began them.
class GdalMessages {
  public:
    /// @param hidden the name of a file or folder that users do not know @param shown what messages say
    /// instead
    explicit GdalMessages(std::string hidden = "", std::string shown = "");
    GdalMessages(const GdalMessages&) = delete;
    GdalMessages& operator=(const GdalMessages&) = delete;
    ~GdalMessages();

    /// Whether GDAL has reported an error, even where the call claimed to have succeeded.
    [[nodiscard]] bool failed() const { return !last_error_.empty(); }
    /// GDAL's last error: one line without a full stop; "GDAL gives no reason" where there is none.
    [[nodiscard]] std::string reason() const;
    /// GDAL's first error: what follows is often no more than its consequence.
    [[nodiscard]] std::string first_reason() const;
    /// The reason without the name of the file that our own sentence has given already.
    [[nodiscard]] std::string reason_for(const std::string& path) const;
    /// One line each, without repetitions, in their order.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

    /// Hands GDAL's warnings on, as quotes.
    void pass_warnings(Warnings& warnings) const;
    /// As pass_warnings(), and errors as well: for calls that have succeeded nevertheless.
    void pass_all(Warnings& warnings) const;

    /// For the callback: remembers one message.
    void add(bool is_error, const char* text);

  private:
    std::string first_error_;
    std::string hidden_;
    std::string shown_;
    std::string last_error_;
    std::vector<std::string> errors_;
    std::vector<std::string> warnings_;
};

/// A message of GDAL's as one line: white space and control characters become single blanks, a full stop at
/// the end goes, and what is too long is cut.
[[nodiscard]] std::string one_line(std::string_view text);

}  // namespace d2b
