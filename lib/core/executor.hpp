#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "core/block_pool.hpp"
#include "core/stop_request.hpp"
#include "dem2buildings/callbacks.hpp"

namespace d2b {

/// The threads of a run. Work is divided by index and results go by index, so that their number shows in the
/// time alone. What is called from inside of such work runs on the thread that calls it.
class Executor {
  public:
    /// @param threads the caller's included; 1 starts none. Where the system starts no more there
    /// are half as many as it would
    /// @param stop asked before each piece of work, by any thread; where it says true the work ends with a
    /// Cancelled
    /// @param on_work told of what each thread does; not of what is called from inside of other work
    explicit Executor(int threads = 1, std::function<bool()> stop = {}, WorkListener on_work = {});
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;
    ~Executor();

    [[nodiscard]] int threads() const;
    /// For work that takes long in one piece.
    [[nodiscard]] const StopRequest& stop() const { return stop_; }
    /// Memory that what the threads worked on gave back.
    [[nodiscard]] const std::shared_ptr<BlockPool>& blocks() const { return blocks_; }

    /// Calls work(i) for each i below `count`, on all threads, and comes back when all are done. Of several
    /// exceptions that of the lowest i is thrown, as in a loop.
    template <typename Work>
    void for_each(std::size_t count, const Work& work) {
        indexed(count, [&](std::size_t i, std::size_t) { work(i); });
    }

    /// The same with room to work in: calls work(i, room), where each thread has a Room of its own, which it
    /// keeps from one i to the next. Results must not depend on what was left in it.
    template <typename Room, typename Work>
    void for_each_in_room(std::size_t count, const Work& work) {
        std::vector<Room> rooms(static_cast<std::size_t>(threads()));
        indexed(count, [&](std::size_t i, std::size_t thread) { work(i, rooms[thread]); });
    }

    /// Calls work(begin, end) for consecutive pieces of [0, count), of `piece` each but the last.
    template <typename Work>
    void for_pieces(std::size_t count, std::size_t piece, const Work& work) {
        for_each((count + piece - 1) / piece, [&](std::size_t i) {
            work(i * piece, i * piece + piece < count ? i * piece + piece : count);
        });
    }

    /// Calls take(i, make(i, thread)) for each i below `count`: make on all threads, `thread` counts from 0
    /// to threads() - 1; take on the caller's alone and in order. Exceptions as from a loop.
    /// @param ahead most values a thread that wait for it
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
    /// @param listener to be told of it; null where there is none
    using Body = std::function<void(std::size_t thread, const WorkListener* listener)>;
    using Indexed = std::function<void(std::size_t i, std::size_t thread)>;

    /// Runs body on all threads, the caller's is 0; on the caller's alone where the others are busy.
    void run(const Body& body);
    void indexed(std::size_t count, const Indexed& work);
    void pipelined(std::size_t count, std::size_t ahead, const Indexed& make,
                   const std::function<void(std::size_t)>& take);

    struct Pool;
    StopRequest stop_;
    WorkListener on_work_;
    std::shared_ptr<BlockPool> blocks_ = std::make_shared<BlockPool>();
    std::unique_ptr<Pool> pool_;
};

}  // namespace d2b
