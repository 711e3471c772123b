#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace d2b {

/// Whole numbers in as few bytes as they need: seven binary digits a byte, the low ones first, and the eighth
/// says that more follow (LEB128).
class PackedNumbers {
  public:
    void put(std::uint64_t number);
    /// Near 0 on either side: 0, -1, 1, -2, 2, ... are 0, 1, 2, 3, 4, ...
    void put_signed(std::int64_t number);

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// As RFC 1950 has it (zlib). @throws OutputError
[[nodiscard]] std::string deflated(std::string_view bytes);
/// As RFC 4648 has it.
[[nodiscard]] std::string base64(std::string_view bytes);
/// The bytes that hexadecimal digits stand for.
[[nodiscard]] std::string bytes_of_hex(std::string_view digits);

}  // namespace d2b
