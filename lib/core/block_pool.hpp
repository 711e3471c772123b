#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/large_pages.hpp"

namespace d2b {

/// Large blocks of memory that grids gave back, for the next ones: the system clears each page that it gives,
/// which takes as long as a pass over it. Where none has the size that is asked for, the pages of those that
/// wait become a block of that size. What waits and what is in use are together no more than was in use at a
/// time. From any thread.
class BlockPool {
  public:
    static constexpr std::size_t large = LargePages::size;  ///< bytes; what is less is not kept

    BlockPool() { idle_.reserve(most_blocks); }
    BlockPool(const BlockPool&) = delete;
    BlockPool& operator=(const BlockPool&) = delete;
    ~BlockPool() { clear(); }

    /// A block of at least so many bytes with whatever was in it. @throws std::bad_alloc
    [[nodiscard]] void* take(std::size_t bytes);
    /// @param bytes that were asked for
    void give(void* block, std::size_t bytes) noexcept;
    /// Gives all that waits back to the system.
    void clear() noexcept;

  private:
    static constexpr std::size_t most_blocks = 64;

    struct Idle {
        void* block;
        std::size_t bytes;
    };
    /// @param size in whole pages @return a block that waited; null where none fits
    [[nodiscard]] void* take_idle(std::size_t size);
    /// Those that wait longest, as many as have the large pages of so many bytes; the last may be cut.
    [[nodiscard]] std::vector<Idle> take_parts(std::size_t size);
    /// A block that begins with the pages of others, which are gone then.
    [[nodiscard]] static void* put_together(std::size_t size, const std::vector<Idle>& parts);
    /// Gives those that wait longest back to the system, until no more than so many bytes do.
    void shrink_to(std::size_t bytes, std::unique_lock<std::mutex>& lock) noexcept;

    std::mutex mutex_;
    std::vector<Idle> idle_;  ///< what was given last is last: it may still be in the cache
    std::size_t idle_bytes_ = 0;
    std::size_t used_bytes_ = 0;
    std::size_t most_used_ = 0;  ///< bytes at a time
};

/// The allocator of a grid's values: large blocks come from a pool, if it has one, and values that nobody
/// sets are whatever was there: most grids are written as a whole by whoever asks for them.
template <typename T>
class CellMemory {
  public:
    using value_type = T;
    using propagate_on_container_copy_assignment = std::true_type;
    using propagate_on_container_move_assignment = std::true_type;
    using propagate_on_container_swap = std::true_type;
    using is_always_equal = std::true_type;  // each can give back what any other took

    CellMemory() = default;
    explicit CellMemory(std::shared_ptr<BlockPool> pool) : pool_(std::move(pool)) {}
    template <typename Other>
    CellMemory(const CellMemory<Other>& other) : pool_(other.pool()) {}

    [[nodiscard]] T* allocate(std::size_t count) {
        if (count < BlockPool::large / sizeof(T))
            return std::allocator<T>().allocate(count);
        const std::size_t bytes = count * sizeof(T);
        return static_cast<T*>(pool_ ? pool_->take(bytes) : LargePages::map(bytes));
    }
    void deallocate(T* values, std::size_t count) noexcept {
        if (count < BlockPool::large / sizeof(T))
            std::allocator<T>().deallocate(values, count);
        else if (pool_)
            pool_->give(values, count * sizeof(T));
        else
            LargePages::unmap(values, count * sizeof(T));
    }
    template <typename U>
    void construct(U* value) noexcept {
        ::new (static_cast<void*>(value)) U;
    }
    template <typename U, typename... Arguments>
    void construct(U* value, Arguments&&... arguments) {
        ::new (static_cast<void*>(value)) U(std::forward<Arguments>(arguments)...);
    }
    [[nodiscard]] const std::shared_ptr<BlockPool>& pool() const { return pool_; }

    friend bool operator==(const CellMemory& /*one*/, const CellMemory& /*other*/) { return true; }

  private:
    std::shared_ptr<BlockPool> pool_;
};

}  // namespace d2b
