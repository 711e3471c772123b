#pragma once

#include <chrono>
#include <sys/resource.h>

#include "core/report.hpp"

namespace d2b {

/// Adds the time until it goes out of scope to a stage of the report. Stages run band by band, so each has
/// many.
class StageClock {
  public:
    StageClock(RunReport& report, Stage stage)
        : report_(report),
          stage_(static_cast<std::size_t>(stage)),
          start_(std::chrono::steady_clock::now()) {}
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;
    ~StageClock() {
        report_.seconds[stage_] +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        report_.peak_memory_bytes[stage_] = static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
    }

  private:
    RunReport& report_;
    std::size_t stage_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace d2b
