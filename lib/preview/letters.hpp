#pragma once

#include <array>
#include <cstdint>

namespace d2b {

inline constexpr int letter_width = 3;
inline constexpr int letter_height = 5;

/// The rows of a letter from the top, the left dot of each in bit 2. Small letters are drawn as capitals,
/// what has no form here as a blank.
[[nodiscard]] std::array<std::uint8_t, letter_height> letter_rows(char letter);

}  // namespace d2b
