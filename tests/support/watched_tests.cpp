// Every test of every program is watched: one that hangs fails, and is not waited for.
#include <memory>

#include <gtest/gtest.h>

#include "support/watchdog.hpp"

namespace d2b::test {
namespace {

class WatchedTests : public testing::EmptyTestEventListener {
  public:
    WatchedTests() = default;
    WatchedTests(const WatchedTests&) = delete;
    WatchedTests& operator=(const WatchedTests&) = delete;
    /// Where a test forks and the child ends by exit(), its watchdog has no thread there to wait for.
    ~WatchedTests() override { static_cast<void>(watchdog_.release()); }

  private:
    void OnTestStart(const testing::TestInfo& test) override {
        watchdog_ = std::make_unique<Watchdog>(std::string(test.test_suite_name()) + "." + test.name());
    }
    void OnTestEnd(const testing::TestInfo& /*test*/) override { watchdog_.reset(); }

    std::unique_ptr<Watchdog> watchdog_;
};

[[maybe_unused]] const bool watched = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new WatchedTests);  // which owns it from here on
    return true;
}();

}  // namespace
}  // namespace d2b::test
