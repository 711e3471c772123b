#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "read/temporary_file.hpp"

namespace d2b {

/// Whether a source is the standard input, which can be read once and only forwards.
[[nodiscard]] bool is_standard_input(std::string_view source);

/// A temporary file that holds what came in on the standard input; removed when this goes.
class KeptStandardInput {
  public:
    /// @param source a name for which is_standard_input() holds
    /// @throws InputError nothing came in. @throws OutputError the temporary file cannot be written
    explicit KeptStandardInput(const std::string& source);

    [[nodiscard]] const std::string& path() const { return file_.path(); }

  private:
    TemporaryFile file_;
};

/// What a source holds where it is the standard input, else null. @throws as above
[[nodiscard]] std::unique_ptr<KeptStandardInput> keep_standard_input(const std::string& source);

}  // namespace d2b
