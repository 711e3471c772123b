#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "pipeline/made_town.hpp"

namespace d2b {
namespace {

using test::MadeTown;
using Texts = std::vector<std::string>;

/// A town that has something to say wherever it is read, on whichever thread.
class TalkingSource final : public DemSource {
  public:
    [[nodiscard]] const DemInfo& info() const override { return town_.info(); }
    void read(const Window& part, std::span<double> elevations) override {
        town_.read(part, elevations);
        const std::lock_guard lock(mutex_);
        said_.push_back("row " + std::to_string(part.row));
        if (fails)
            throw InputError("a bad block");
    }
    [[nodiscard]] std::vector<std::string> take_warnings() override {
        const std::lock_guard lock(mutex_);
        return std::exchange(said_, {});
    }
    bool fails = false;

  private:
    test::MemorySource town_ = MadeTown::source(MadeTown::surface());
    std::mutex mutex_;
    std::vector<std::string> said_;
};

class TalkingSink final : public test::MemorySink {
  public:
    void take_report(const RunReport& report) override { told = report; }
    [[nodiscard]] std::vector<std::string> take_warnings() override {
        return std::exchange(finished_, finished) != finished ? Texts{"finished"} : Texts{};
    }
    RunReport told;

  private:
    bool finished_ = false;
};

TEST(Callbacks, AreCalledFromTheCallersThread) {
    for (const Preset preset : {Preset::buildings, Preset::thesis}) {
        TalkingSource dem;
        TalkingSink sink;
        Options options;
        options.preset = preset;
        options.run.threads = 4;
        std::set<std::thread::id> threads;
        Texts heard;
        Callbacks callbacks;
        callbacks.on_warning = [&](const std::string& text) {
            threads.insert(std::this_thread::get_id());
            heard.push_back(text);
        };
        callbacks.on_progress = [&](double) {
            threads.insert(std::this_thread::get_id());
            return true;
        };
        callbacks.make_spool = [&] {
            threads.insert(std::this_thread::get_id());
            return std::make_unique<MemorySpool>();
        };
        const RunReport report = run(options, {dem}, {sink}, callbacks, {.points = 1, .keep_bytes = 0});
        EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
        EXPECT_EQ(heard, report.warnings);
        // One text a band, however often it is read, and what finishing showed at the end.
        EXPECT_EQ(std::ranges::count(heard, "row 0"), 1);
        EXPECT_EQ(heard.back(), "finished");
    }
}

TEST(Callbacks, HearWhatThreadsWorkOn) {
    TalkingSource dem;
    TalkingSink sink;
    Options options;
    options.run.threads = 2;
    std::mutex mutex;
    std::set<std::size_t> threads;
    std::set<std::string> works;
    Callbacks callbacks;
    callbacks.on_work = [&](const WorkSpan& span) {
        const std::lock_guard lock(mutex);
        threads.insert(span.thread);
        works.insert(span.work->name());
    };
    run(options, {dem}, {sink}, callbacks);
    EXPECT_EQ(threads, (std::set<std::size_t>{0, 1}));
    for (const std::string function : {"ElevationReader", "write_features"})
        EXPECT_TRUE(std::ranges::any_of(works, [&](const std::string& work) {
            return work.find(function) != std::string::npos;
        })) << function;
}

TEST(Callbacks, HearWhatASourceHadToSayBeforeItFailed) {
    TalkingSource dem;
    dem.fails = true;
    test::MemorySink sink;
    Texts heard;
    Callbacks callbacks;
    callbacks.on_warning = [&](const std::string& text) { heard.push_back(text); };
    EXPECT_THROW(run({}, {dem}, {sink}, callbacks), InputError);
    EXPECT_EQ(heard.size(), 1U);
}

/// What a program throws out of its own function ends the run and comes out of it.
TEST(Callbacks, MayThrow) {
    TalkingSource dem;
    test::MemorySink sink;
    Callbacks callbacks;
    callbacks.on_warning = [](const std::string& text) { throw std::invalid_argument(text); };
    EXPECT_THROW(run({}, {dem}, {sink}, callbacks), std::invalid_argument);
    EXPECT_FALSE(sink.finished);
    callbacks.on_warning = {};
    callbacks.on_progress = [](double share) -> bool { throw share; };
    EXPECT_THROW(run({}, {dem}, {sink}, callbacks), double);
    EXPECT_FALSE(sink.finished);
}

TEST(Callbacks, ServeSeveralRunsAtATime) {
    std::atomic<int> asked = 0;
    Callbacks callbacks;
    callbacks.stop = [&] { return ++asked < 0; };
    const auto town = [&](double& rmse) {
        test::TownRun run;
        run.callbacks = callbacks;
        run.run();
        rmse = run.report.stack_rmse_m;
    };
    double one = 0;
    double other = 0;
    std::thread beside(town, std::ref(one));
    town(other);
    beside.join();
    EXPECT_GT(one, 0);
    EXPECT_EQ(one, other);
    EXPECT_GT(asked, 0);
}

TEST(Sinks, AreToldOfTheRunBeforeTheyFinish) {
    TalkingSource dem;
    TalkingSink sink;
    const RunReport report = run({}, {dem}, {sink});
    EXPECT_EQ(sink.told.buildings, 3);
    EXPECT_EQ(sink.told.buildings, report.buildings);
    EXPECT_EQ(sink.told.vertices, report.vertices);
}

TEST(Reports, CountWhatTheTerrainModelLeftOut) {
    class Terrain final : public test::MemorySource {
      public:
        Terrain() : MemorySource(MadeTown::rows, MadeTown::cols, MadeTown::terrain()) {}
        [[nodiscard]] std::int64_t cells_outside_range() const override { return 7; }
    };
    Terrain terrain;
    test::TownRun town;
    town.terrain = &terrain;
    town.options.ground.mode = GroundMode::given;
    town.run();
    EXPECT_EQ(town.report.counted(Reason::terrain_outside_range), 7);
}

}  // namespace
}  // namespace d2b
