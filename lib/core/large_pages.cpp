#include "core/large_pages.hpp"

#include <cstdint>
#include <sys/mman.h>

namespace d2b {

void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    constexpr std::size_t large = std::size_t{2} << 20;
    constexpr std::size_t worth_while = 4 * large;
    if (bytes < worth_while)
        return;
    // Whole large pages of the block alone. What comes back is of no interest: it is but a wish.
    const auto begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::size_t before = (large - begin % large) % large;
    static_cast<void>(
        madvise(static_cast<std::byte*>(memory) + before, (bytes - before) / large * large, MADV_HUGEPAGE));
#endif
}

}  // namespace d2b
