#pragma once

#include <chrono>
#include <sys/resource.h>

#include "dem2buildings/report.hpp"

namespace d2b {

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
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        tally_.peak_memory_bytes[stage_] = static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
    }

  private:
    Tally& tally_;
    std::size_t stage_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace d2b
