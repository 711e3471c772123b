#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/executor.hpp"
#include "core/spool.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/report.hpp"

namespace d2b {

/// What every stage gets beside its input: the report it adds to, the threads it may use, and the caller's
/// ears. The library has no globals, prints nothing and ends no process.
struct Context {
    RunReport report;
    std::optional<std::size_t> told;  ///< warnings that the report of the last run ended with; empty before
    std::function<void(const std::string&)> on_warning;  ///< may be empty
    std::function<bool(double)> on_progress;  ///< share done, 0 to 1; false asks to stop; may be empty
    std::function<bool()> stop;               ///< true asks to stop; any thread asks, and often; may be empty
    std::unique_ptr<Executor> threads = std::make_unique<Executor>();  ///< never empty
    /// Where what is finished waits for its turn: in memory, or in a file (write/file_spool.hpp).
    std::function<std::unique_ptr<Spool>()> make_spool = [] { return std::make_unique<MemorySpool>(); };

    void warn(std::string text) {
        if (on_warning)
            on_warning(text);
        report.warnings.push_back(std::move(text));
    }
    /// For loops over what one object consists of. @throws Cancelled
    void check_stop() const {
        if (stop && stop())
            throw Cancelled();
    }
    /// @throws Cancelled
    void progress(double share) const {
        if (on_progress && !on_progress(share))
            throw Cancelled();
    }
};

}  // namespace d2b
