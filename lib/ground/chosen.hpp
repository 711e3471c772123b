#pragma once

#include <bit>
#include <cstdint>

namespace d2b::ground {

/// The first value where `first` is 1, the second where it is 0. By bits, as compilers make a branch of a
/// condition.
[[nodiscard]] inline float chosen(std::uint8_t first, float a, float b) {
    const std::uint32_t mask = 0U - first;
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) |
                                (std::bit_cast<std::uint32_t>(b) & ~mask));
}

}  // namespace d2b::ground
