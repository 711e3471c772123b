#include "core/block_pool.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <sys/mman.h>

namespace d2b {
namespace {

constexpr std::size_t large_page = std::size_t{2} << 20;
// A multiple of what any system calls a page. Not a large one: what a block has beyond these is small pages.
constexpr std::size_t page = std::size_t{64} << 10;

std::size_t whole_pages(std::size_t bytes) {
    if (bytes > std::numeric_limits<std::size_t>::max() - 2 * large_page)
        throw std::bad_alloc();
    return (bytes + page - 1) / page * page;
}

}  // namespace

void* BlockPool::from_system(std::size_t bytes) {
    const std::size_t size = whole_pages(bytes);
    // A large page more, of which what lies before the block and behind it goes back.
    void* const memory =
        mmap(nullptr, size + large_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
        throw std::bad_alloc();
    auto* const begin = static_cast<std::byte*>(memory);
    const std::size_t before =
        (large_page - reinterpret_cast<std::uintptr_t>(memory) % large_page) % large_page;
    if (before > 0)
        munmap(begin, before);
    if (before < large_page)
        munmap(begin + before + size, large_page - before);
#ifdef MADV_HUGEPAGE
    static_cast<void>(
        madvise(begin + before, size, MADV_HUGEPAGE));  // a wish: what comes back is of no interest
#endif
    return begin + before;
}

void BlockPool::to_system(void* block, std::size_t bytes) noexcept {
    munmap(block, whole_pages(bytes));
}

void* BlockPool::take(std::size_t bytes) {
    const std::size_t size = whole_pages(bytes);
    {
        std::unique_lock lock(mutex_);
        used_bytes_ += size;
        if (void* const block = take_idle(size))
            return block;
        most_used_ = std::max(most_used_, used_bytes_);
        shrink_to(most_used_ - used_bytes_, lock);
    }
    try {
        return from_system(bytes);
    } catch (const std::bad_alloc&) {
        const std::lock_guard lock(mutex_);
        used_bytes_ -= size;
        throw;
    }
}

void* BlockPool::take_idle(std::size_t size) {
    const auto found =
        std::find_if(idle_.rbegin(), idle_.rend(), [&](const Idle& idle) { return idle.bytes == size; });
    if (found == idle_.rend())
        return nullptr;
    void* const block = found->block;
    idle_.erase(std::next(found).base());
    idle_bytes_ -= size;
    return block;
}

void BlockPool::give(void* block, std::size_t bytes) noexcept {
    const std::size_t size = whole_pages(bytes);
    {
        const std::lock_guard lock(mutex_);
        used_bytes_ -= size;
        if (idle_.size() < most_blocks && idle_bytes_ + size <= most_used_ - used_bytes_) {
            idle_.push_back({block, size});
            idle_bytes_ += size;
            return;
        }
    }
    to_system(block, bytes);
}

void BlockPool::clear() noexcept {
    std::unique_lock lock(mutex_);
    shrink_to(0, lock);
    most_used_ = used_bytes_;
}

void BlockPool::shrink_to(std::size_t bytes, std::unique_lock<std::mutex>& lock) noexcept {
    while (idle_bytes_ > bytes) {
        const Idle longest = idle_.front();
        idle_.erase(idle_.begin());
        idle_bytes_ -= longest.bytes;
        lock.unlock();  // the system takes its time for large blocks
        to_system(longest.block, longest.bytes);
        lock.lock();
    }
}

}  // namespace d2b
