#include "core/large_pages.hpp"

#include <cstdint>
#include <limits>
#include <new>
#include <sys/mman.h>

namespace d2b {
namespace {

constexpr std::size_t page = std::size_t{64} << 10;  // multiple of the page size of any system

}  // namespace

std::size_t LargePages::whole(std::size_t bytes) {
    if (bytes > std::numeric_limits<std::size_t>::max() - 2 * size)
        throw std::bad_alloc();
    return (bytes + page - 1) / page * page;
}

void* LargePages::map(std::size_t bytes) {
    const std::size_t length = whole(bytes);
    // Map one large page more, then unmap the excess before and behind the aligned block.
    void* const memory =
        mmap(nullptr, length + size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
        throw std::bad_alloc();
    auto* const begin = static_cast<std::byte*>(memory);
    const std::size_t before = (size - reinterpret_cast<std::uintptr_t>(memory) % size) % size;
    if (before > 0)
        munmap(begin, before);
    if (before < size)
        munmap(begin + before + length, size - before);
#ifdef MADV_HUGEPAGE
    static_cast<void>(
        madvise(begin + before, length, MADV_HUGEPAGE));  // advisory only; the result is deliberately ignored
#endif
    return begin + before;
}

void LargePages::unmap(void* block, std::size_t bytes) noexcept {
    munmap(block, whole(bytes));
}

bool LargePages::move(void* from, void* to, std::size_t bytes) noexcept {
    std::size_t moved = 0;
#ifdef MREMAP_FIXED
    // Move pages one at a time, because adjacent pages of different origin cannot be moved in one call.
    for (; moved < bytes; moved += size)
        if (mremap(static_cast<std::byte*>(from) + moved, size, size, MREMAP_MAYMOVE | MREMAP_FIXED,
                   static_cast<std::byte*>(to) + moved) == MAP_FAILED)
            break;
#endif
    if (moved == bytes)
        return true;
    munmap(static_cast<std::byte*>(from) + moved, bytes - moved);
    // A failed move may have unmapped its target.
    void* const rest = static_cast<std::byte*>(to) + moved;
    return mmap(rest, bytes - moved, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1,
                0) != MAP_FAILED;
}

}  // namespace d2b
