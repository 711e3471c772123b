#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/block_pool.hpp"
#include "core/stop_token.hpp"
#include "dem2buildings/callbacks.hpp"

namespace d2b {

/// Thread pool of a run.
///
/// Work is divided by index and results are stored by index, so the number of threads affects only the run
/// time. Nested calls run on the calling thread. Not a general task queue: there is one loop at a time.
///
///     executor.for_each(rows, [&](std::size_t row) { sums[row] = sum_of(grid.row(row)); });
class Executor {
  public:
    /// @param threads including the caller's; 1 starts none. If the system refuses to start that many, half
    /// of those that it would start are used
    /// @param stop checked by any thread before each work item; if it returns true, the loop throws Cancelled
    /// @param on_work receives the work of each thread, except for nested calls
    explicit Executor(int threads = 1, std::function<bool()> stop = {}, WorkListener on_work = {});
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;
    ~Executor();

    [[nodiscard]] int threads() const;
    /// Returns the stop request, for work items that take long.
    [[nodiscard]] const StopToken& stop() const { return stop_; }
    /// Returns the pool of memory released by earlier grids of these threads.
    [[nodiscard]] const std::shared_ptr<BlockPool>& blocks() const { return blocks_; }

    /// Calls work(i) for each i below `count` on all threads and returns when all are done. If several throw,
    /// the exception of the lowest i is rethrown, as in a sequential loop.
    template <typename Work>
    void for_each(std::size_t count, const Work& work) {
        indexed(count, [&](std::size_t i, std::size_t) { work(i); });
    }

    /// Same, with scratch space: calls work(i, room) with one Room per thread, which is reused for every i.
    /// Results must not depend on its previous contents.
    template <typename Room, typename Work>
    void for_each_with_scratch(std::size_t count, const Work& work) {
        std::vector<Room> rooms(static_cast<std::size_t>(threads()));
        indexed(count, [&](std::size_t i, std::size_t thread) { work(i, rooms[thread]); });
    }

    /// Calls work(begin, end) for consecutive pieces of [0, count), of `piece` each except the last.
    template <typename Work>
    void for_chunks(std::size_t count, std::size_t piece, const Work& work) {
        for_each((count + piece - 1) / piece, [&](std::size_t i) {
            work(i * piece, i * piece + piece < count ? i * piece + piece : count);
        });
    }

    /// Calls take(i, make(i, thread)) for each i below `count`: make() on all threads (`thread` counts from 0
    /// to threads() - 1), take() on the caller's thread only and in order. Exceptions as from a loop. @param
    /// ahead maximum number of values per thread that wait for take()
    template <typename Make, typename Take>
    void in_order(std::size_t count, const Make& make, const Take& take, std::size_t ahead = 8) {
        std::vector<std::optional<decltype(make(std::size_t{}, std::size_t{}))>> made(
            ahead * static_cast<std::size_t>(threads()));
        pipelined(
            count, made.size(),
            [&](std::size_t i, std::size_t thread) { made[i % made.size()].emplace(make(i, thread)); },
            [&](std::size_t i) {
                auto value = std::move(*made[i % made.size()]);
                made[i % made.size()].reset();
                take(i, std::move(value));
            });
    }

  private:
    /// @param listener told of the work; may be null
    using Body = std::function<void(std::size_t thread, const WorkListener* listener)>;
    using Indexed = std::function<void(std::size_t i, std::size_t thread)>;

    /// Runs body on all threads (the caller's is 0), or on the caller's alone if the others are busy.
    void run(const Body& body);
    void indexed(std::size_t count, const Indexed& work);
    void pipelined(std::size_t count, std::size_t ahead, const Indexed& make,
                   const std::function<void(std::size_t)>& take);

    struct Pool;
    StopToken stop_;
    WorkListener on_work_;
    std::shared_ptr<BlockPool> blocks_ = std::make_shared<BlockPool>();
    std::unique_ptr<Pool> pool_;
};

}  // namespace d2b
