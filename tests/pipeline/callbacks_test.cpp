#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "options/option_table.hpp"
#include "pipeline/made_town.hpp"
#include "pipeline/tall_blocks.hpp"
#include "support/error_of.hpp"

namespace d2b::test {
namespace {

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
    MemorySource town_ = MadeTown::source(MadeTown::surface());
    std::mutex mutex_;
    std::vector<std::string> said_;
};

class TalkingSink final : public MemorySink {
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
        // One text a band, however often it is read, and the text from the end.
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
    MemorySink sink;
    Texts heard;
    Callbacks callbacks;
    callbacks.on_warning = [&](const std::string& text) { heard.push_back(text); };
    EXPECT_THROW(run({}, {dem}, {sink}, callbacks), InputError);
    EXPECT_EQ(heard.size(), 1U);
}

/// An exception from the program's own function ends the run and comes out of it.
TEST(Callbacks, MayThrow) {
    TalkingSource dem;
    MemorySink sink;
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
        TownRun run;
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
    class Terrain final : public MemorySource {
      public:
        Terrain() : MemorySource(MadeTown::rows, MadeTown::cols, MadeTown::terrain()) {}
        [[nodiscard]] std::int64_t cells_outside_range() const override { return 7; }
    };
    Terrain terrain;
    TownRun town;
    town.terrain = &terrain;
    town.options.ground.mode = GroundMode::given;
    town.run();
    EXPECT_EQ(town.report.counted(Reason::terrain_outside_range), 7);
}

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
    MemorySource whole_ = tall_blocks();
    std::mutex mutex_;
    std::map<std::int32_t, int> seen_;
};

class BandFaults : public testing::TestWithParam<std::tuple<Preset, int>> {
  protected:
    static void run_on(DemSource& source, const Callbacks& callbacks, MemorySink& sink) {
        run(of_preset(std::get<0>(GetParam()), std::get<1>(GetParam())), {source}, {sink}, callbacks,
            small_bands);
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
        EXPECT_EQ(error_of<InputError>([&] { run_on(source, {}, sink); }), "a bad block");
        EXPECT_FALSE(sink.finished);
    }
}

/// Exceptions that are no Error of ours are treated the same.
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

std::string exact(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%a ", value);
    return text.data();
}

void add_ring(std::string& text, const WorldRing& ring) {
    for (const Position& position : ring)
        text += exact(position.x) + exact(position.y);
    text += "| ";
}

/// All that was written, to the last bit.
std::string text_of(const MemorySink& sink) {
    std::string text;
    for (const auto& layer : sink.features)
        for (const Feature& feature : layer) {
            text += "\nfeature " + exact(feature.z);
            for (const FieldValue& value : feature.values)
                if (const auto* number = std::get_if<double>(&value))
                    text += exact(*number);
                else if (const auto* whole = std::get_if<std::int64_t>(&value))
                    text += std::to_string(*whole) + " ";
                else if (const auto* word = std::get_if<std::string>(&value))
                    text += *word + " ";
            for (const WorldPolygon& part : feature.parts) {
                add_ring(text, part.exterior);
                for (const WorldRing& ring : part.interiors)
                    add_ring(text, ring);
            }
        }
    return text;
}

struct Case {
    Preset preset;
    TraceMode mode;
    std::optional<double> interval;  ///< of levels, in place of the preset's
    double detail = 0;
};

class Bands : public testing::TestWithParam<Case> {
  protected:
    /// @param first_row of the window: the first band ends at row 64
    static std::string result(std::int32_t first_row, int threads, const BandSize& size) {
        MemorySource source = tall_blocks();
        source.edit().window.row = first_row;
        source.edit().window.rows -= first_row;
        Options options = of_preset(GetParam().preset, threads);
        options.trace.mode = GetParam().mode;
        options.levels.interval = GetParam().interval;
        options.levels.detail = GetParam().detail;
        MemorySink sink;
        run(options, {source}, {sink}, {}, size);
        return text_of(sink);
    }
};

TEST_P(Bands, TheirNumberDoesNotShow) {
    for (const std::int32_t first_row : {0, 62, 63}) {
        const std::string whole = result(first_row, 1, {});
        EXPECT_GT(whole.size(), 10000U);
        for (const int threads : {1, 2, 16})
            for (const std::size_t room : {std::size_t{0}, std::size_t{1} << 30})
                EXPECT_TRUE(result(first_row, threads, {0, room}) == whole)
                    << first_row << " " << threads << " " << room;
    }
}

INSTANTIATE_TEST_SUITE_P(, Bands,
                         testing::Values(Case{Preset::thesis, TraceMode::points, {}},
                                         Case{Preset::thesis, TraceMode::points, 0.04},  // counts of 16 bits
                                         Case{Preset::thesis, TraceMode::cells, {}},
                                         Case{Preset::buildings, TraceMode::points, {}},
                                         Case{Preset::buildings, TraceMode::cells, {}},
                                         Case{Preset::buildings, TraceMode::cells, {}, 1}));

}  // namespace
}  // namespace d2b::test
