#include "core/system/memory.hpp"

#include <sys/mman.h>
#include <sys/resource.h>

namespace d2b::system {

void* map_memory(std::size_t bytes, std::size_t alignment) noexcept {
    // Map one alignment more, then unmap the excess before and behind the aligned block.
    void* const memory =
        ::mmap(nullptr, bytes + alignment, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
        return nullptr;
    auto* const begin = static_cast<std::byte*>(memory);
    const std::size_t before = (alignment - reinterpret_cast<std::uintptr_t>(memory) % alignment) % alignment;
    if (before > 0)
        ::munmap(begin, before);
    if (before < alignment)
        ::munmap(begin + before + bytes, alignment - before);
#ifdef MADV_HUGEPAGE
    // Advisory only; the result is deliberately ignored.
    static_cast<void>(::madvise(begin + before, bytes, MADV_HUGEPAGE));
#endif
    return begin + before;
}

void unmap_memory(void* block, std::size_t bytes) noexcept {
    ::munmap(block, bytes);
}

bool can_divide_blocks() {
    return true;
}

bool move_memory([[maybe_unused]] void* from, [[maybe_unused]] void* to,
                 [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MREMAP_FIXED
    return ::mremap(from, bytes, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, to) != MAP_FAILED;
#else
    return false;
#endif
}

bool map_memory_at(void* address, std::size_t bytes) noexcept {
    return ::mmap(address, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) !=
           MAP_FAILED;
}

std::int64_t peak_memory_bytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    constexpr std::int64_t unit = 1;
#else
    constexpr std::int64_t unit = 1024;
#endif
    return static_cast<std::int64_t>(usage.ru_maxrss) * unit;
}

}  // namespace d2b::system
