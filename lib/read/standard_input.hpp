#pragma once

#include <string>
#include <string_view>

namespace d2b {

/// Whether a source is the standard input, which can be read once and only forwards.
[[nodiscard]] bool is_standard_input(std::string_view source);

/// A temporary file that holds what came in on the standard input; removed when this goes.
class SpooledInput {
  public:
    /// @param source a name for which is_standard_input() holds
    /// @throws InputError nothing came in. @throws OutputError the temporary file cannot be written
    explicit SpooledInput(const std::string& source);
    SpooledInput(const SpooledInput&) = delete;
    SpooledInput& operator=(const SpooledInput&) = delete;
    ~SpooledInput();

    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_;
};

}  // namespace d2b
