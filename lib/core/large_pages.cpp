#include "core/large_pages.hpp"

#include <cstdint>
#include <sys/mman.h>

namespace d2b {
namespace {

constexpr std::size_t large_page = std::size_t{2} << 20;
constexpr std::size_t worth_while = 4 * large_page;

/// Whole large pages of a block of memory.
struct Pages {
    Pages(void* memory, std::size_t bytes) {
        const auto address = reinterpret_cast<std::uintptr_t>(memory);
        const std::size_t before = (large_page - address % large_page) % large_page;
        if (bytes >= worth_while) {
            begin = static_cast<std::byte*>(memory) + before;
            size = (bytes - before) / large_page * large_page;
        }
    }
    std::byte* begin = nullptr;
    std::size_t size = 0;
};

}  // namespace

// What comes back from the system is of no interest: these are wishes.

void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    if (const Pages pages(memory, bytes); pages.size > 0)
        static_cast<void>(madvise(pages.begin, pages.size, MADV_HUGEPAGE));
#endif
}

void get_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes,
               [[maybe_unused]] Executor& threads) {
#ifdef MADV_POPULATE_WRITE
    const Pages pages(memory, bytes);
    threads.for_pieces(pages.size, worth_while, [&](std::size_t begin, std::size_t end) {
        static_cast<void>(madvise(pages.begin + begin, end - begin, MADV_POPULATE_WRITE));
    });
#endif
}

}  // namespace d2b
