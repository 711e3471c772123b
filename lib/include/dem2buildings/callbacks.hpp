#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <typeinfo>

#include "dem2buildings/spool.hpp"

namespace d2b {

/// Time span in which a thread of a run worked without waiting for another thread.
struct WorkSpan {
    std::size_t thread = 0;                ///< 0: the thread that called run()
    const std::type_info* work = nullptr;  ///< type of the stage's function; never null
    std::chrono::steady_clock::time_point begin;
    std::chrono::steady_clock::time_point end;
};
/// Called from any thread, possibly concurrently. Must not throw.
using WorkListener = std::function<void(const WorkSpan& span)>;

/// Functions that a program may give to the library: for warnings, progress and cancellation, and storage for
/// pending results. All are optional. Stateless with respect to a run, so one object serves any number of
/// runs, also concurrent ones if its functions allow that. An exception thrown by a function ends the call
/// that invoked it.
///
///     d2b::Callbacks callbacks;
///     callbacks.on_warning = [](const std::string& text) { std::cerr << text << '\n'; };
struct Callbacks {
    /// Receives a sentence about a doubtful result, or a decision made on the caller's behalf. Called from
    /// the thread that called run(), open_dem() and so on, before these return.
    std::function<void(const std::string& text)> on_warning;
    /// Receives the completed share, from 0 to 1, never decreasing. Returns false to cancel the run, which
    /// then throws Cancelled. Called from the thread that called run().
    std::function<bool(double share)> on_progress;
    /// Returns true to cancel, which throws Cancelled; once true, it must stay true. Called from any thread,
    /// concurrently and often, because cancellation should be quick, so it should only read an atomic. Must
    /// not throw.
    std::function<bool()> stop;
    /// Creates storage for finished results that wait for their turn: in memory, or for example in a
    /// FileSpool (dem2buildings/spool.hpp). Called from the thread that called run(); the spools are used
    /// from any thread.
    std::function<std::unique_ptr<Spool>()> make_spool = [] { return std::make_unique<MemorySpool>(); };
    /// Receives every finished span of shared work, for example for a timeline. In between, the thread that
    /// called run() works alone.
    WorkListener on_work;
};

}  // namespace d2b
