#include "support/watchdog.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <pthread.h>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace d2b::test {
namespace {

struct Process {
    pid_t id = 0;
    pid_t parent = 0;
    double seconds = 0;  ///< of its threads and of those of its children that have ended
};

/// One line of /proc/<id>/stat; the name in it may hold blanks and parentheses.
bool parse(const std::string& line, Process& process) {
    const std::size_t name_end = line.rfind(')');
    if (name_end == std::string::npos)
        return false;
    std::istringstream before(line);
    std::istringstream after(line.substr(name_end + 1));
    char state = ' ';
    before >> process.id;
    after >> state >> process.parent;
    std::string skipped;
    for (int field = 5; field < 14; ++field)
        after >> skipped;
    double ticks = 0;
    for (int field = 14; field < 18; ++field) {
        double more = 0;
        after >> more;
        ticks += more;
    }
    process.seconds = ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
    return !after.fail();
}

std::vector<Process> all_processes() {
    std::vector<Process> all;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
        const std::string name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos)
            continue;
        std::ifstream file(entry.path() / "stat");
        std::string line;
        Process process;
        if (std::getline(file, line) && parse(line, process))
            all.push_back(process);
    }
    return all;
}

/// All that descends from this process, without it.
std::vector<Process> descendants() {
    const std::vector<Process> all = all_processes();
    std::vector<Process> found;
    std::vector<pid_t> parents{getpid()};
    for (std::size_t i = 0; i < parents.size(); ++i)
        for (const Process& process : all)
            if (process.parent == parents[i]) {
                found.push_back(process);
                parents.push_back(process.id);
            }
    return found;
}

double seconds(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Processor time of this process but for the calling thread, and of all processes below it.
double work_done() {
    rusage ended{};
    getrusage(RUSAGE_CHILDREN, &ended);
    double work = seconds(CLOCK_PROCESS_CPUTIME_ID) - seconds(CLOCK_THREAD_CPUTIME_ID) +
                  seconds(ended.ru_utime) + seconds(ended.ru_stime);
    for (const Process& process : descendants())
        work += process.seconds;
    return work;
}

[[noreturn]] void end(const std::string& watched, const std::string& why) {
    static_cast<void>(std::fprintf(stderr, "Watchdog: %s %s\n", watched.c_str(), why.c_str()));
    for (const Process& process : descendants())
        ::kill(process.id, SIGKILL);
    std::_Exit(1);
}

/// Held while a watchdog's thread does anything but wait.
std::mutex& looking() {
    static std::mutex mutex;
    return mutex;
}

/// A child has this thread alone, so that a lock that another one holds at the fork, as the allocator's, is
/// never given back in it.
void fork_between_looks() {
    static const int registered =
        pthread_atfork([] { looking().lock(); }, [] { looking().unlock(); }, [] { looking().unlock(); });
    static_cast<void>(registered);
}

std::string text_of(std::chrono::milliseconds time) {
    return std::to_string(static_cast<double>(time.count()) / 1000).substr(0, 6) + " s";
}

}  // namespace

Watchdog::Watchdog(std::string watched, const Limits& limits)
    : watched_(std::move(watched)), limits_(limits), thread_([this] { watch(); }) {
    fork_between_looks();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waits_; });  // a thread that starts allocates
}

Watchdog::~Watchdog() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

/// Looks are counted and not the time between them, which passes for a process that was set aside as well.
void Watchdog::watch() {
    constexpr int looks = 12;                 // in the time that may pass
    constexpr double least_share = 1 / 600.;  // of one processor; a sanitizer's own thread uses less
    const std::chrono::milliseconds step = limits_.idle / looks;
    const double least = least_share * static_cast<double>(limits_.idle.count()) / 1000;
    std::unique_lock lock(mutex_);
    double before = -1;  // the first look, which most tests do not live to see, finds all of it
    int idle = 0;
    waits_ = true;
    changed_.notify_all();
    for (int look = 1; !changed_.wait_for(lock, step, [this] { return over_; }); ++look) {
        const std::lock_guard look_lock(looking());
        const double now = work_done();
        const bool moved = now - before >= least || now < before;
        idle = moved ? 0 : idle + 1;
        before = moved ? now : before;
        if (idle >= looks)
            end(watched_, "hangs: no thread has made progress for " + text_of(limits_.idle) + ".");
        if (look * step >= limits_.whole)
            end(watched_, "has not ended after " + text_of(limits_.whole) + ".");
    }
}

}  // namespace d2b::test
