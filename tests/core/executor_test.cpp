#include "core/executor.hpp"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <malloc.h>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

class Executors : public testing::TestWithParam<int> {
  protected:
    Executor threads{GetParam()};
};

TEST_P(Executors, HaveTheThreadsThatWereAskedFor) {
    EXPECT_EQ(threads.threads(), GetParam());
}

TEST_P(Executors, DoEachPieceOfWorkOnce) {
    std::vector<int> done(1000);
    threads.for_each(done.size(), [&](std::size_t i) { ++done[i]; });
    EXPECT_EQ(done, std::vector<int>(1000, 1));
    threads.for_each(0, [](std::size_t) { FAIL(); });
}

TEST_P(Executors, WorkOnAllThreadsAtOnce) {
    // Each waits for all others: one after the other they would wait for ever.
    std::atomic<int> arrived = 0;
    threads.for_each(static_cast<std::size_t>(GetParam()), [&](std::size_t) {
        ++arrived;
        while (arrived < GetParam())
            std::this_thread::yield();
    });
    EXPECT_EQ(arrived, GetParam());
}

TEST_P(Executors, CutARangeIntoPieces) {
    std::vector<int> done(10);
    threads.for_chunks(done.size(), 4, [&](std::size_t begin, std::size_t end) {
        EXPECT_EQ(begin % 4, 0U);
        for (std::size_t i = begin; i < end; ++i)
            ++done[i];
    });
    EXPECT_EQ(done, std::vector<int>(10, 1));
}

TEST_P(Executors, ThrowTheExceptionOfTheLowestIndex) {
    for (int repeat = 0; repeat < 100; ++repeat) {
        std::vector<int> done(100);
        try {
            threads.for_each(done.size(), [&](std::size_t i) {
                if (i == 20 || i == 21 || i == 70)
                    throw std::runtime_error(std::to_string(i));
                ++done[i];
            });
            FAIL() << "nothing was thrown";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "20");
        }
        EXPECT_EQ(std::accumulate(done.begin(), done.begin() + 20, 0), 20);
    }
}

TEST_P(Executors, HandOverInOrder) {
    std::vector<std::string> taken;
    const std::thread::id caller = std::this_thread::get_id();
    threads.in_order(
        500,
        [&](std::size_t i, std::size_t thread) {
            EXPECT_LT(thread, static_cast<std::size_t>(GetParam()));
            return std::to_string(i * i);
        },
        [&](std::size_t i, std::string value) {
            EXPECT_EQ(std::this_thread::get_id(), caller);
            EXPECT_EQ(i, taken.size());
            taken.push_back(std::move(value));
        });
    ASSERT_EQ(taken.size(), 500U);
    for (std::size_t i = 0; i < taken.size(); ++i)
        EXPECT_EQ(taken[i], std::to_string(i * i));
}

TEST_P(Executors, HandOverWhatComesBeforeAFailure) {
    for (int repeat = 0; repeat < 100; ++repeat) {
        std::vector<std::size_t> taken;
        EXPECT_THROW(threads.in_order(
                         100,
                         [](std::size_t i, std::size_t) {
                             if (i == 30)
                                 throw std::runtime_error("made");
                             return i;
                         },
                         [&](std::size_t, std::size_t value) { taken.push_back(value); }),
                     std::runtime_error);
        EXPECT_EQ(taken.size(), 30U);
        taken.clear();
        EXPECT_THROW(threads.in_order(
                         100, [](std::size_t i, std::size_t) { return i; },
                         [&](std::size_t i, std::size_t) {
                             if (i == 40)
                                 throw std::runtime_error("taken");
                             taken.push_back(i);
                         }),
                     std::runtime_error);
        EXPECT_EQ(taken.size(), 40U);
    }
}

TEST_P(Executors, MayBeCalledFromInside) {
    std::vector<std::vector<int>> done(8, std::vector<int>(50));
    threads.for_each(done.size(), [&](std::size_t i) {
        threads.for_each(done[i].size(), [&](std::size_t k) { ++done[i][k]; });
    });
    EXPECT_EQ(done, std::vector<std::vector<int>>(8, std::vector<int>(50, 1)));
}

TEST_P(Executors, StopBeforeWhatWasMadeIsTaken) {
    std::atomic<bool> stop = false;
    Executor stopped(GetParam(), [&] { return stop.load(); });
    std::size_t taken = 0;
    EXPECT_THROW(stopped.in_order(
                     100, [](std::size_t i, std::size_t) { return i; },
                     [&](std::size_t i, std::size_t) {
                         taken = i;
                         stop = i == 50;
                     }),
                 Cancelled);
    EXPECT_EQ(taken, 50U);
}

/// Spans of several threads.
struct HeardSpans {
    std::mutex mutex;
    std::vector<WorkSpan> spans;

    void operator()(const WorkSpan& span) {
        const std::lock_guard lock(mutex);
        spans.push_back(span);
    }
};

TEST_P(Executors, TellWhatEachThreadDidAndWhen) {
    HeardSpans heard;
    Executor told(GetParam(), {}, std::ref(heard));
    const auto work = [&](std::size_t) { told.for_each(10, [](std::size_t) {}); };  // of these nobody is told
    const auto begin = std::chrono::steady_clock::now();
    told.for_each(100, work);
    const auto end = std::chrono::steady_clock::now();
    ASSERT_EQ(heard.spans.size(), static_cast<std::size_t>(GetParam()));
    std::set<std::size_t> seen;
    for (const WorkSpan& span : heard.spans) {
        seen.insert(span.thread);
        EXPECT_NE(std::string(span.work->name()).find("TellWhatEachThreadDidAndWhen"), std::string::npos);
        EXPECT_TRUE(begin <= span.begin && span.begin <= span.end && span.end <= end);
    }
    EXPECT_EQ(seen.size(), heard.spans.size());
}

TEST(ExecutorSpans, LeaveWaitsOut) {
    HeardSpans heard;
    Executor told(2, {}, std::ref(heard));
    constexpr std::chrono::milliseconds nap(30);
    // The caller takes one value at a time and naps; the other thread cannot make more than it may hold
    // ahead.
    const auto begin = std::chrono::steady_clock::now();
    told.in_order(
        8, [](std::size_t i, std::size_t) { return i; },
        [&](std::size_t, std::size_t) { std::this_thread::sleep_for(nap); }, 1);
    const auto whole = std::chrono::steady_clock::now() - begin;
    std::chrono::steady_clock::duration other{};
    for (const WorkSpan& span : heard.spans)
        other += span.thread == 1 ? span.end - span.begin : std::chrono::steady_clock::duration();
    EXPECT_GE(whole, 8 * nap);
    EXPECT_LT(other, whole / 2);
}

/// Room for some stacks, and no more: the threads that start do all the work, and have room for it.
void work_in_little_room() {
    rlimit room{};
    room.rlim_cur = room.rlim_max = rlim_t{1} << 30;
    setrlimit(RLIMIT_AS, &room);
    mallopt(M_ARENA_MAX, 1);  // threads that allocate at once would reserve all of it for later
    Executor threads(100000);
    const std::vector<char> room_to_work(std::size_t{1} << 27);
    std::vector<int> done(1000);
    if (threads.threads() > 1 && threads.threads() < 100000)
        threads.for_each(done.size(), [&](std::size_t i) { done[i] = 1; });
    std::_Exit(done == std::vector<int>(1000, 1) ? 0 : 1);
}

TEST(ExecutorDeathTest, HasFewerThreadsWhereTheSystemStartsNoMore) {
    if (D2B_SANITIZED != 0)
        GTEST_SKIP() << "the sanitizers take more room than there is";
    GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process of its own, whose room can be limited
    EXPECT_EXIT(work_in_little_room(), testing::ExitedWithCode(0), "");
}

INSTANTIATE_TEST_SUITE_P(, Executors, testing::Values(1, 2, 3, 8));

}  // namespace
}  // namespace d2b
