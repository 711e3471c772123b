#pragma once

#include <bit>
#include <cstdint>

namespace d2b::ground {

/// Returns a if `first` is 1, b if it is 0. Branch-free, because the compiler turns ?: into a branch here.
[[nodiscard]] inline float chosen(std::uint8_t first, float a, float b) {
    const std::uint32_t mask = 0U - first;
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) |
                                (std::bit_cast<std::uint32_t>(b) & ~mask));
}

}  // namespace d2b::ground
