#include "core/system/process.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <dlfcn.h>
#include <unistd.h>

namespace d2b::system {

std::vector<std::string> arguments(int argc, const char* const* argv) {
    return {argv + std::min(argc, 1), argv + argc};
}

std::int64_t process_id() {
    return ::getpid();
}

std::filesystem::path data_beside_program() {
    return {};
}

void* load_symbol(const char* library, const char* function, std::string& reason) {
    void* const opened = ::dlopen(library, RTLD_LAZY | RTLD_LOCAL);
    void* const found = opened != nullptr ? ::dlsym(opened, function) : nullptr;
    if (found == nullptr) {
        const char* const text = ::dlerror();  // NOLINT(concurrency-mt-unsafe): of this thread alone
        reason = text != nullptr ? text : library;
    }
    return found;
}

void* find_symbol(const char* function) {
    return ::dlsym(RTLD_DEFAULT, function);
}

void catch_signals(void (*handler)(int)) {
    for (const int signal : std::array{SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        // Who started this process in the background, or with nohup, may have set the signal aside; it stays
        // aside.
        if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN)
            continue;
        // Without SA_RESTART: a read that waits for the standard input has to give up.
        struct sigaction action {};
        action.sa_handler = handler;
        action.sa_flags = static_cast<int>(SA_RESETHAND);
        sigemptyset(&action.sa_mask);
        static_cast<void>(::sigaction(signal, &action, nullptr));
    }
}

void ignore_file_size_signal() {
    static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
}

IgnoreBrokenPipe::IgnoreBrokenPipe() : before_(std::signal(SIGPIPE, SIG_IGN)) {}

IgnoreBrokenPipe::~IgnoreBrokenPipe() {
    static_cast<void>(std::signal(SIGPIPE, before_));
}

}  // namespace d2b::system
