#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "core/executor.hpp"
#include "core/system/memory.hpp"
#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/report.hpp"

namespace d2b {

/// Everything that a stage of one run gets besides its input: the caller's callbacks, the report to add to
/// and the threads to use. Passed explicitly because the library has no globals, prints nothing and never
/// ends the process.
struct Context : Callbacks {
    RunReport report;
    std::unique_ptr<Executor> threads = std::make_unique<Executor>();  ///< never null

    Context() = default;
    explicit Context(Callbacks callbacks) : Callbacks(std::move(callbacks)) {}

    /// Reports a warning once per text. Only for the thread that called run().
    void warn(const std::string& text) {
        if (std::ranges::find(report.warnings, text) != report.warnings.end())
            return;
        report.warnings.push_back(text);
        if (on_warning)
            on_warning(text);
    }
    /// Call this in loops over the parts of one object. @throws Cancelled
    void check_stop() const {
        if (stop && stop())
            throw Cancelled();
    }
    /// Reports the share that is done. Only for the thread that called run(). @throws Cancelled
    void progress(double share) const {
        if (on_progress && !on_progress(share))
            throw Cancelled();
    }
};

/// Maps progress from 0 to 1, as reported through a context, to a part [begin, end] of the whole as long as
/// it lives.
class ProgressSpan {
  public:
    ProgressSpan(Context& context, double begin, double end)
        : context_(context), outer_(std::exchange(context.on_progress, {})) {
        if (outer_)
            context.on_progress = [this, begin, end](double share) {
                return outer_(begin + (end - begin) * share);
            };
    }
    ProgressSpan(const ProgressSpan&) = delete;
    ProgressSpan& operator=(const ProgressSpan&) = delete;
    ~ProgressSpan() { context_.on_progress = std::move(outer_); }

  private:
    Context& context_;
    std::function<bool(double)> outer_;
};

/// Adds its lifetime to the time of a stage. Stages run band by band, so each has many.
class StageClock {
  public:
    StageClock(Tally& tally, Stage stage)
        : tally_(tally), stage_(static_cast<std::size_t>(stage)), start_(std::chrono::steady_clock::now()) {}
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;
    ~StageClock() {
        constexpr double worth_a_call =
            1e-3;  // memory hardly grows in a shorter time, so the system call is skipped
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        tally_.seconds[stage_] += seconds;
        if (seconds < worth_a_call && tally_.peak_memory_bytes[stage_] > 0)
            return;
        tally_.peak_memory_bytes[stage_] = system::peak_memory_bytes();
    }

  private:
    Tally& tally_;
    std::size_t stage_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace d2b
