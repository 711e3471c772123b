#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace d2b::test {

/// Ends the program where its work hangs: with a message and status 1, and with the programs that it
/// started. Looks at processor time, because threads that wait for each other use none: at that of all
/// threads of this process, and of all processes below it.
class Watchdog {
  public:
    struct Limits {
        std::chrono::milliseconds idle = std::chrono::minutes(1);  ///< next to no processor time is used
        std::chrono::milliseconds whole = std::chrono::hours(1);   ///< whatever is used
    };

    /// @param watched its name in the message
    explicit Watchdog(std::string watched) : Watchdog(std::move(watched), Limits()) {}
    Watchdog(std::string watched, const Limits& limits);
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;
    ~Watchdog();

  private:
    void watch();

    std::string watched_;
    Limits limits_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool waits_ = false;
    bool over_ = false;
    std::thread thread_;
};

}  // namespace d2b::test
