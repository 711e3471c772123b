#pragma once

#include <cstddef>

namespace d2b {

/// Maps memory for blocks of several megabytes, in huge pages if the system provides them: touching 100 MB
/// then takes 50 page faults instead of 25,000, which would take longer than most passes.
class LargePages {
  public:
    static constexpr std::size_t size = std::size_t{2} << 20;  ///< bytes of one large page

    /// Rounds up to whole pages, not large ones: the rest of a block beyond its large pages is small pages.
    /// @throws std::bad_alloc
    [[nodiscard]] static std::size_t whole(std::size_t bytes);

    /// Returns the bytes of a block that are in large pages, which come first.
    [[nodiscard]] static constexpr std::size_t in(std::size_t bytes) { return bytes / size * size; }

    /// Maps a zeroed block that begins at a large page boundary. @throws std::bad_alloc
    [[nodiscard]] static void* map(std::size_t bytes);
    static void unmap(void* block, std::size_t bytes) noexcept;

    /// Moves large pages with their contents from `from` to `to`, because the system then need not clear new
    /// ones. Pages that cannot be moved are replaced by fresh ones; `from` is always unmapped. @param bytes a
    /// multiple of `size`, as are both addresses @return false if fresh pages could not be mapped either, so
    /// that part of `to` is unmapped
    [[nodiscard]] static bool move(void* from, void* to, std::size_t bytes) noexcept;
};

}  // namespace d2b
