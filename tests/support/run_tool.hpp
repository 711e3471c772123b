#pragma once

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <spawn.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <thread>
#include <time.h>
#include <unistd.h>
#include <vector>

namespace d2b::test {

struct Kill {
    int signal = SIGKILL;
    std::chrono::milliseconds after{0};
    double cpu_seconds = 0;  ///< that it has used by then; nothing is sent to a tool that ends before
};

struct ToolSetup {
    std::string stdin_text{};                ///< text that the tool can read; nothing by default
    std::vector<std::string> environment{};  ///< NAME=VALUE, in place of or beside those of this process
    std::string working_directory{};         ///< this process's where empty
    std::string stdout_file{};               ///< where stdout goes, "/dev/full" say; captured where empty
    std::optional<Kill> kill{};              ///< a signal to send while it runs
};

struct ToolResult {
    int status = 0;  ///< of exit; 128 + the signal where one ended it, as shells say
    std::string out;
    std::string err;
    double cpu_seconds = 0;
    double cpu_seconds_at_signal = 0;  ///< used before the signal was sent; 0 where none was
    std::int64_t peak_bytes = 0;
};

namespace run_tool_detail {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// A file without a name. Unlike pipes, files cannot fill up and stop both sides.
inline File scratch_file() {
    File file(std::tmpfile(), &std::fclose);
    if (!file)
        throw std::runtime_error("cannot make a temporary file");
    return file;
}

inline std::string text_of(std::FILE* file) {
    std::rewind(file);
    std::string text;
    std::array<char, 65536> buffer{};
    while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file))
        text.append(buffer.data(), n);
    return text;
}

/// Pointers to the texts and a null pointer, as exec wants them. Valid as long as the texts are.
inline std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> result;
    for (std::string& text : texts)
        result.push_back(text.data());
    result.push_back(nullptr);
    return result;
}

/// @param changes NAME=VALUE
inline std::vector<std::string> merged_environment(const std::vector<std::string>& changes) {
    std::vector<std::string> merged = changes;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string text(*entry);
        const std::string name = text.substr(0, text.find('=') + 1);
        bool changed = false;
        for (const std::string& change : changes)
            changed = changed || change.starts_with(name);
        if (!changed)
            merged.push_back(text);
    }
    return merged;
}

/// Which files a child process gets for stdin, stdout and stderr, and where it works.
class FileActions {
  public:
    FileActions() { posix_spawn_file_actions_init(&actions_); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
    ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }

    void use(std::FILE* file, int descriptor) {
        posix_spawn_file_actions_adddup2(&actions_, fileno(file), descriptor);
    }
    void use(const std::string& path, int descriptor) {
        posix_spawn_file_actions_addopen(&actions_, descriptor, path.c_str(), O_WRONLY | O_CREAT, 0666);
    }
    void work_in(const std::string& directory) {
        posix_spawn_file_actions_addchdir_np(&actions_, directory.c_str());
    }
    [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

  private:
    posix_spawn_file_actions_t actions_{};
};

/// Signals that this process may have been started to ignore do their work in the child.
class SpawnAttributes {
  public:
    SpawnAttributes() {
        posix_spawnattr_init(&attributes_);
        sigset_t signals;
        sigemptyset(&signals);
        for (const int signal : {SIGINT, SIGTERM, SIGPIPE})
            sigaddset(&signals, signal);
        posix_spawnattr_setsigdefault(&attributes_, &signals);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF);
    }
    SpawnAttributes(const SpawnAttributes&) = delete;
    SpawnAttributes& operator=(const SpawnAttributes&) = delete;
    ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }

    [[nodiscard]] const posix_spawnattr_t* get() const { return &attributes_; }

  private:
    posix_spawnattr_t attributes_{};
};

inline double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Processor time of a process that has not been waited for.
inline double cpu_seconds_of(pid_t process) {
    clockid_t clock = 0;
    timespec time{};
    if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0)
        return 0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

inline bool has_ended(pid_t process) {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           info.si_pid == process;
}

/// Waits, and notes how it ended and how much time and memory it took.
inline void wait_for(pid_t process, const std::optional<Kill>& signal, ToolResult& result) {
    if (signal) {
        std::this_thread::sleep_for(signal->after);
        while (cpu_seconds_of(process) < signal->cpu_seconds && !has_ended(process))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        result.cpu_seconds_at_signal = cpu_seconds_of(process);
        ::kill(process, signal->signal);
    }
    int status = 0;
    rusage usage{};
    while (wait4(process, &status, 0, &usage) < 0)
        if (errno != EINTR)
            throw std::runtime_error("cannot wait for the tool");
    result.status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    result.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    result.peak_bytes = std::int64_t{usage.ru_maxrss} * 1024;
}

}  // namespace run_tool_detail

/// Runs a command line, without a shell, until it ends.
/// @param command the program's path, or a name to look up in PATH, and its arguments
/// @throws std::runtime_error where it cannot be started
inline ToolResult run_tool(std::vector<std::string> command, const ToolSetup& setup = {}) {
    using namespace run_tool_detail;
    const File in = scratch_file();
    const File out = scratch_file();
    const File err = scratch_file();
    std::fwrite(setup.stdin_text.data(), 1, setup.stdin_text.size(), in.get());
    std::rewind(in.get());

    FileActions actions;
    actions.use(in.get(), STDIN_FILENO);
    if (setup.stdout_file.empty())
        actions.use(out.get(), STDOUT_FILENO);
    else
        actions.use(setup.stdout_file, STDOUT_FILENO);
    actions.use(err.get(), STDERR_FILENO);
    if (!setup.working_directory.empty())
        actions.work_in(setup.working_directory);

    std::vector<std::string> environment = merged_environment(setup.environment);
    const SpawnAttributes attributes;
    pid_t process = 0;
    if (posix_spawnp(&process, command.at(0).c_str(), actions.get(), attributes.get(),
                     pointers(command).data(), pointers(environment).data()) != 0)
        throw std::runtime_error("cannot start " + command[0]);
    ToolResult result;
    wait_for(process, setup.kill, result);
    result.out = text_of(out.get());
    result.err = text_of(err.get());
    return result;
}

}  // namespace d2b::test
