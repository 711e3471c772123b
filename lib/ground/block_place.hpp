#pragma once

#include <array>
#include <cstdint>

namespace d2b::ground {

/// Where a block lies, or a step from one block to another.
struct BlockPlace {
    std::int32_t row;
    std::int32_t col;
};

inline constexpr std::array<BlockPlace, 4> block_sides{{{-1, 0}, {0, -1}, {0, 1}, {1, 0}}};
inline constexpr std::array<BlockPlace, 8> blocks_around{
    {{-1, -1}, {-1, 0}, {-1, 1}, {0, -1}, {0, 1}, {1, -1}, {1, 0}, {1, 1}}};

}  // namespace d2b::ground
