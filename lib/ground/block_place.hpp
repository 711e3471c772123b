#pragma once

#include <array>
#include <cstdint>

namespace d2b::ground {

/// Position of a block, or offset between two blocks.
struct BlockPlace {
    std::int32_t row;
    std::int32_t col;
};

inline constexpr std::array<BlockPlace, 4> block_sides{{{-1, 0}, {0, -1}, {0, 1}, {1, 0}}};
inline constexpr std::array<BlockPlace, 8> blocks_around{
    {{-1, -1}, {-1, 0}, {-1, 1}, {0, -1}, {0, 1}, {1, -1}, {1, 0}, {1, 1}}};

}  // namespace d2b::ground
