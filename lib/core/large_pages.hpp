#pragma once

#include <cstddef>

namespace d2b {

/// Memory of the system's, for blocks of some megabytes and more. Where the system can it gives large pages:
/// 100 MB are then touched in 50 steps instead of 25,000, which otherwise take longer than most passes.
class LargePages {
  public:
    static constexpr std::size_t size = std::size_t{2} << 20;  ///< bytes of one

    /// So many bytes in whole pages, not large ones: what a block has beyond these is small pages.
    /// @throws std::bad_alloc
    [[nodiscard]] static std::size_t whole(std::size_t bytes);

    /// How many of so many bytes are in large pages, where these come first.
    [[nodiscard]] static constexpr std::size_t in(std::size_t bytes) { return bytes / size * size; }

    /// A block of so many bytes, which begins with a large page; all of it is 0. @throws std::bad_alloc
    [[nodiscard]] static void* map(std::size_t bytes);
    static void unmap(void* block, std::size_t bytes) noexcept;

    /// Puts large pages with whatever is in them into the place of others: the system need not clear these,
    /// as it does those that it gives. Of those that it cannot move new ones are there; nothing is left at
    /// `from`.
    /// @param bytes a multiple of `size`, as both addresses are
    /// @return false: it could do neither, and some of `to` is no memory
    [[nodiscard]] static bool move(void* from, void* to, std::size_t bytes) noexcept;
};

}  // namespace d2b
