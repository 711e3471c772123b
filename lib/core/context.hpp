#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "core/executor.hpp"
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

}  // namespace d2b
