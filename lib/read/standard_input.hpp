#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "read/temporary_file.hpp"

namespace d2b {

/// Returns true if a source is standard input, which can be read only once and only forwards.
[[nodiscard]] bool is_standard_input(std::string_view source);

/// Temporary copy of standard input; the destructor removes it.
class KeptStandardInput {
  public:
    /// @param source name that satisfies is_standard_input()
    /// @throws InputError nothing came in. @throws OutputError the temporary file cannot be written
    explicit KeptStandardInput(const std::string& source);

    [[nodiscard]] const std::string& path() const { return file_.path(); }

  private:
    TemporaryFile file_;
};

/// Copies the source if it is standard input; returns null otherwise. @throws as above
[[nodiscard]] std::unique_ptr<KeptStandardInput> keep_standard_input(const std::string& source);

}  // namespace d2b
