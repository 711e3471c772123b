#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "options/option_table.hpp"
#include "pipeline/tall_blocks.hpp"

namespace d2b {
namespace {

using test::MemorySink;
using test::MemorySource;

/// A read of a run: its first row, and the how manieth of that row it is, which tells the passes apart.
using Read = std::pair<std::int32_t, int>;

/// Calls a fault at one of its reads.
class FaultySource final : public DemSource {
  public:
    [[nodiscard]] const DemInfo& info() const override { return whole_.info(); }
    void read(const Window& part, std::span<double> elevations) override {
        Read now{part.row, 0};
        {
            const std::lock_guard lock(mutex_);
            now.second = ++seen_[part.row];
            reads.push_back(now);
        }
        if (now == at) {
            std::this_thread::sleep_for(std::chrono::milliseconds(3));  // the others get ahead
            fault();
        }
        whole_.read(part, elevations);
    }

    Read at{-1, 0};
    std::function<void()> fault;
    std::vector<Read> reads;

  private:
    MemorySource whole_ = test::tall_blocks();
    std::mutex mutex_;
    std::map<std::int32_t, int> seen_;
};

class BandFaults : public testing::TestWithParam<std::tuple<Preset, int>> {
  protected:
    static void run_on(DemSource& source, const Callbacks& callbacks, MemorySink& sink) {
        run(test::of_preset(std::get<0>(GetParam()), std::get<1>(GetParam())), {source}, {sink}, callbacks,
            test::small_bands);
    }
    /// All reads of a run.
    static std::vector<Read> reads() {
        FaultySource source;
        MemorySink sink;
        run_on(source, {}, sink);
        EXPECT_FALSE(sink.features[0].empty());
        return source.reads;
    }
};

TEST_P(BandFaults, AReadThatFailsEndsTheRun) {
    const std::vector<Read> all = reads();
    EXPECT_GE(all.size(), 2U * 7);
    for (const Read& read : all) {
        FaultySource source;
        source.at = read;
        source.fault = [] { throw InputError("a bad block"); };
        MemorySink sink;
        try {
            run_on(source, {}, sink);
            FAIL() << "row " << read.first << ", time " << read.second;
        } catch (const InputError& error) {
            EXPECT_STREQ(error.what(), "a bad block");
        }
        EXPECT_FALSE(sink.finished);
    }
}

/// What is no Error of ours is no other matter.
TEST_P(BandFaults, NoMemoryForABandEndsTheRun) {
    for (const Read& read : reads()) {
        FaultySource source;
        source.at = read;
        source.fault = [] { throw std::bad_alloc(); };
        MemorySink sink;
        EXPECT_THROW(run_on(source, {}, sink), std::bad_alloc);
        EXPECT_FALSE(sink.finished);
    }
}

TEST_P(BandFaults, AStopEndsTheRun) {
    for (const Read& read : reads()) {
        std::atomic<bool> stop = false;
        FaultySource source;
        source.at = read;
        source.fault = [&] { stop = true; };
        Callbacks callbacks;
        callbacks.stop = [&] { return stop.load(); };
        MemorySink sink;
        EXPECT_THROW(run_on(source, callbacks, sink), Cancelled) << read.first << " " << read.second;
        EXPECT_FALSE(sink.finished);
    }
}

/// The last share that is reported tells that the result is there; nobody can stop it then.
TEST_P(BandFaults, ProgressThatIsRefusedEndsTheRun) {
    int calls = 0;
    for (int at = 1;; ++at) {
        FaultySource source;
        Callbacks callbacks;
        MemorySink sink;
        calls = 0;
        callbacks.on_progress = [&](double) { return ++calls != at; };
        try {
            run_on(source, callbacks, sink);
            break;
        } catch (const Cancelled&) {
            EXPECT_EQ(calls, at);
            EXPECT_FALSE(sink.finished);
        }
    }
    EXPECT_GE(calls, 2 * 7);
}

INSTANTIATE_TEST_SUITE_P(, BandFaults,
                         testing::Combine(testing::ValuesIn(every_preset), testing::Values(1, 2, 16)));

}  // namespace
}  // namespace d2b
