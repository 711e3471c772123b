#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <typeinfo>

#include "dem2buildings/spool.hpp"

namespace d2b {

/// A stretch of time in which a thread of a run did its share of some work and waited for no other thread.
struct WorkSpan {
    std::size_t thread = 0;                ///< 0: the one that called run()
    const std::type_info* work = nullptr;  ///< the function that a stage had the threads call; never empty
    std::chrono::steady_clock::time_point begin;
    std::chrono::steady_clock::time_point end;
};
/// Called from any thread, from several at a time. It must not throw.
using WorkListener = std::function<void(const WorkSpan& span)>;

/// What a program gives the library beside its data: ears for warnings and progress, a way to stop, and room
/// for what has to wait; none has to be given. Nothing of a run is kept in it, so it serves any number of
/// runs, also at the same time if its functions do. What a function throws ends the call that it was called
/// from.
struct Callbacks {
    /// Told of what the result is doubtful for, or what was decided in the caller's place: a sentence. Called
    /// from the thread that called run(), open_dem() and so on, before these return.
    std::function<void(const std::string& text)> on_warning;
    /// Told of the share that is done, from 0 to 1, never less than before; false asks to stop, with a
    /// Cancelled. Called from the thread that called run().
    std::function<bool(double share)> on_progress;
    /// Whether to stop, with a Cancelled: true, then true forever. Called from any thread, from several at a
    /// time, and often: it should look at an atomic and no more. It must not throw.
    std::function<bool()> stop;
    /// Where what is finished waits for its turn: in memory, or say in a FileSpool
    /// (dem2buildings/spool.hpp). Called from the thread that called run(); spools are used from any.
    std::function<std::unique_ptr<Spool>()> make_spool = [] { return std::make_unique<MemorySpool>(); };
    /// Told of each stretch of work that threads share, when it is done: what a timeline is made of. Between
    /// these the thread that called run() works alone.
    WorkListener on_work;
};

}  // namespace d2b
