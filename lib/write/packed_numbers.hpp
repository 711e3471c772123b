#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace d2b {

/// Variable-length integers (LEB128): seven bits per byte, low bits first; the eighth bit says that more
/// follow.
class PackedNumbers {
  public:
    void put(std::uint64_t number);
    /// ZigZag encoding: 0, -1, 1, -2, 2, ... become 0, 1, 2, 3, 4, ...
    void put_signed(std::int64_t number);

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// Compresses with zlib (RFC 1950). @throws OutputError
[[nodiscard]] std::string deflated(std::string_view bytes);
/// Encodes as Base64 (RFC 4648).
[[nodiscard]] std::string base64(std::string_view bytes);
/// Decodes hexadecimal digits.
[[nodiscard]] std::string bytes_of_hex(std::string_view digits);

}  // namespace d2b
