#include "core/block_pool.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <new>

#include "core/system/memory.hpp"

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
    void* const block = system::map_memory(whole(bytes), size);
    if (block == nullptr)
        throw std::bad_alloc();
    return block;
}

void LargePages::unmap(void* block, std::size_t bytes) noexcept {
    system::unmap_memory(block, whole(bytes));
}

bool LargePages::move(void* from, void* to, std::size_t bytes) noexcept {
    std::size_t moved = 0;
    // Move pages one at a time, because adjacent pages of different origin cannot be moved in one call.
    while (moved < bytes && system::move_memory(static_cast<std::byte*>(from) + moved,
                                                static_cast<std::byte*>(to) + moved, size))
        moved += size;
    if (moved == bytes)
        return true;
    system::unmap_memory(static_cast<std::byte*>(from) + moved, bytes - moved);
    // A failed move may have unmapped its target.
    return system::map_memory_at(static_cast<std::byte*>(to) + moved, bytes - moved);
}

void* BlockPool::take(std::size_t bytes) {
    const std::size_t size = LargePages::whole(bytes);
    std::vector<Idle> parts;
    {
        std::unique_lock lock(mutex_);
        void* const block = take_idle(size);
        if (block == nullptr)
            parts = take_parts(size);
        used_bytes_ += size;
        if (block != nullptr)
            return block;
        most_used_ = std::max(most_used_, used_bytes_);
        shrink_to(most_used_ - used_bytes_, lock);
    }
    try {
        return put_together(size, parts);
    } catch (const std::bad_alloc&) {
        const std::lock_guard lock(mutex_);
        used_bytes_ -= size;
        throw;
    }
}

std::vector<BlockPool::Idle> BlockPool::take_parts(std::size_t size) {
    std::vector<Idle> parts;
    if (!system::can_divide_blocks())
        return parts;
    parts.reserve(idle_.size());
    for (std::size_t room = LargePages::in(size); room > 0 && !idle_.empty();) {
        Idle& longest = idle_.front();
        const std::size_t pages = std::min(LargePages::in(longest.bytes), room);
        room -= pages;
        const bool cut = longest.bytes - pages >= large;
        parts.push_back({longest.block, cut ? pages : longest.bytes});
        idle_bytes_ -= parts.back().bytes;
        if (cut)
            longest = {static_cast<std::byte*>(longest.block) + pages, longest.bytes - pages};
        else
            idle_.erase(idle_.begin());
    }
    return parts;
}

void* BlockPool::put_together(std::size_t size, const std::vector<Idle>& parts) {
    std::byte* block = nullptr;
    try {
        block = static_cast<std::byte*>(LargePages::map(size));
    } catch (const std::bad_alloc&) {  // not enough memory for the new block and the idle ones together
        for (const Idle& part : parts)
            LargePages::unmap(part.block, part.bytes);
        return LargePages::map(size);
    }
    bool whole = true;
    std::byte* next = block;
    for (const Idle& part : parts) {
        const std::size_t room = LargePages::in(size) - static_cast<std::size_t>(next - block);
        const std::size_t pages = whole ? std::min(LargePages::in(part.bytes), room) : 0;
        whole = whole && LargePages::move(part.block, next, pages);
        next += pages;
        if (part.bytes > pages)
            LargePages::unmap(static_cast<std::byte*>(part.block) + pages, part.bytes - pages);
    }
    if (whole)
        return block;
    LargePages::unmap(block, size);
    throw std::bad_alloc();
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
    const std::size_t size = LargePages::whole(bytes);
    {
        const std::lock_guard lock(mutex_);
        used_bytes_ -= size;
        if (idle_.size() < most_blocks && idle_bytes_ + size <= most_used_ - used_bytes_) {
            idle_.push_back({block, size});
            idle_bytes_ += size;
            return;
        }
    }
    LargePages::unmap(block, bytes);
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
        lock.unlock();  // releasing large blocks takes long
        LargePages::unmap(longest.block, longest.bytes);
        lock.lock();
    }
}

}  // namespace d2b
