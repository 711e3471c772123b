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

/// What every stage of one run gets beside its input: what the caller gave, the report that the stages add to
/// and the threads that they may use. The library has no globals, prints nothing and ends no process.
struct Context : Callbacks {
    RunReport report;
    std::unique_ptr<Executor> threads = std::make_unique<Executor>();  ///< never empty

    Context() = default;
    explicit Context(Callbacks callbacks) : Callbacks(std::move(callbacks)) {}

    /// From the caller's thread alone. A text counts once.
    void warn(const std::string& text) {
        if (std::ranges::find(report.warnings, text) != report.warnings.end())
            return;
        report.warnings.push_back(text);
        if (on_warning)
            on_warning(text);
    }
    /// For loops over what one object consists of. @throws Cancelled
    void check_stop() const {
        if (stop && stop())
            throw Cancelled();
    }
    /// From the caller's thread alone. @throws Cancelled
    void progress(double share) const {
        if (on_progress && !on_progress(share))
            throw Cancelled();
    }
};

}  // namespace d2b
