#include "support/watchdog.hpp"

#include <cstdlib>
#include <future>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "support/run_tool.hpp"

namespace d2b::test {
namespace {

using namespace std::chrono_literals;

/// Each program that is watched is one of its own.
class WatchdogDeathTest : public testing::Test {
  protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

void wait_for_ever() {
    const Watchdog watchdog("Band.three", {600ms, 1h});
    std::promise<void> never;
    never.get_future().wait();
}

void wait_for_a_program() {
    const Watchdog watchdog("Band.four", {600ms, 1h});
    static_cast<void>(run_tool({"sleep", "1000"}));
}

void work_for(std::chrono::milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < end) {
    }
}

TEST_F(WatchdogDeathTest, EndsWhatWaitsForEver) {
    EXPECT_EXIT(wait_for_ever(), testing::ExitedWithCode(1),
                "Watchdog: Band.three hangs: no thread has made progress for 0.6000 s.");
}

TEST_F(WatchdogDeathTest, EndsWhatWaitsForAProgram) {
    EXPECT_EXIT(wait_for_a_program(), testing::ExitedWithCode(1), "Watchdog: Band.four hangs");
}

TEST_F(WatchdogDeathTest, EndsWhatWorksForEver) {
    EXPECT_EXIT(
        {
            const Watchdog watchdog("Band.five", {600ms, 2s});
            work_for(10min);
        },
        testing::ExitedWithCode(1), "Watchdog: Band.five has not ended after 2.0000 s.");
}

TEST_F(WatchdogDeathTest, LetsThreadsAndProgramsWork) {
    EXPECT_EXIT(
        {
            const Watchdog watchdog("Band.six", {600ms, 1h});
            std::thread([] { work_for(2s); }).join();
            const ToolResult busy = run_tool({"timeout", "2", "sh", "-c", "while :; do :; done"});
            std::_Exit(busy.status == 124 ? 0 : 3);
        },
        testing::ExitedWithCode(0), "^$");
}

TEST_F(WatchdogDeathTest, DoesNotHoldUpAChildThatExits) {
    GTEST_FLAG_SET(death_test_style, "fast");  // a fork, without the thread that watches
    EXPECT_EXIT(std::exit(7), testing::ExitedWithCode(7), "");
}

TEST_F(WatchdogDeathTest, LooksAtNothingDuringAFork) {
    EXPECT_EXIT(
        {
            const Watchdog watchdog("Band.eight", {1200ms, 1h});  // a look in 0.1 s
            const auto end = std::chrono::steady_clock::now() + 1s;
            while (std::chrono::steady_clock::now() < end) {
                const pid_t child = ::fork();
                if (child == 0)
                    std::_Exit(std::string(1000, 'x').size() == 1000 ? 0 : 1);  // asks the allocator
                int status = 1;
                ::waitpid(child, &status, 0);
                if (status != 0)
                    std::_Exit(3);
            }
            std::_Exit(0);
        },
        testing::ExitedWithCode(0), "^$");
}

TEST_F(WatchdogDeathTest, IsCalledOffAtOnce) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 100; ++i)
        const Watchdog watchdog("Band.seven");
    EXPECT_LT(std::chrono::steady_clock::now() - start, 5s);
}

}  // namespace
}  // namespace d2b::test
