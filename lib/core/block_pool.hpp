#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

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

/// Reuses large blocks of memory released by grids, because clearing fresh pages takes the system as long as
/// a pass over them. If no idle block has the requested size, pages of idle blocks are moved into a new one.
/// Idle and used bytes together never exceed the peak of used bytes. Thread-safe.
class BlockPool {
  public:
    static constexpr std::size_t large = LargePages::size;  ///< bytes; smaller blocks are not pooled

    BlockPool() { idle_.reserve(most_blocks); }
    BlockPool(const BlockPool&) = delete;
    BlockPool& operator=(const BlockPool&) = delete;
    ~BlockPool() { clear(); }

    /// Returns a block of at least `bytes` bytes with undefined contents. @throws std::bad_alloc
    [[nodiscard]] void* take(std::size_t bytes);
    /// Takes a block back. @param bytes as requested from take()
    void give(void* block, std::size_t bytes) noexcept;
    /// Returns all idle blocks to the system.
    void clear() noexcept;

  private:
    static constexpr std::size_t most_blocks = 64;

    struct Idle {
        void* block;
        std::size_t bytes;
    };
    /// @param size in whole pages @return an idle block of exactly this size, or nullptr
    [[nodiscard]] void* take_idle(std::size_t size);
    /// Removes the longest idle blocks until their large pages add up to `size`; the last one may be split.
    [[nodiscard]] std::vector<Idle> take_parts(std::size_t size);
    /// Maps a block and moves the pages of `parts` to its beginning. The parts are unmapped.
    [[nodiscard]] static void* put_together(std::size_t size, const std::vector<Idle>& parts);
    /// Returns the longest idle blocks to the system until at most `bytes` are idle.
    void shrink_to(std::size_t bytes, std::unique_lock<std::mutex>& lock) noexcept;

    std::mutex mutex_;
    std::vector<Idle> idle_;  ///< most recently released last, because it may still be in the cache
    std::size_t idle_bytes_ = 0;
    std::size_t used_bytes_ = 0;
    std::size_t most_used_ = 0;  ///< peak of used_bytes_
};

/// Allocator of a grid's values. Large blocks come from a pool, if there is one, and values are not
/// initialised, because most grids are overwritten as a whole.
template <typename T>
class CellAllocator {
  public:
    using value_type = T;
    using propagate_on_container_copy_assignment = std::true_type;
    using propagate_on_container_move_assignment = std::true_type;
    using propagate_on_container_swap = std::true_type;
    using is_always_equal = std::true_type;  // any instance can release memory of any other

    CellAllocator() = default;
    explicit CellAllocator(std::shared_ptr<BlockPool> pool) : pool_(std::move(pool)) {}
    template <typename Other>
    CellAllocator(const CellAllocator<Other>& other) : pool_(other.pool()) {}

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

    friend bool operator==(const CellAllocator& /*one*/, const CellAllocator& /*other*/) { return true; }

  private:
    std::shared_ptr<BlockPool> pool_;
};

}  // namespace d2b
