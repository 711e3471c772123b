#include "core/system/process.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <dlfcn.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "core/system/data_folder.hpp"

namespace d2b::system {
namespace {

/// The program, or the module that this function is in.
std::filesystem::path own_file() {
    Dl_info about{};
    std::error_code error;
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): systems take functions as data
    const bool known = ::dladdr(reinterpret_cast<const void*>(&own_file), &about) != 0;
    std::filesystem::path file = known && about.dli_fname != nullptr ? about.dli_fname : "";
    // A program goes by the word that started it, which need not be a path.
    if (!file.has_parent_path())
        file = std::filesystem::read_symlink("/proc/self/exe", error);
    else if (std::filesystem::path whole = std::filesystem::canonical(file, error); !error)
        file = std::move(whole);
    return file;
}

}  // namespace

std::vector<std::string> arguments(int argc, const char* const* argv) {
    return {argv + std::min(argc, 1), argv + argc};
}

std::int64_t process_id() {
    return ::getpid();
}

const std::filesystem::path& data_beside_program() {
    static const std::filesystem::path data = data_folder_of(own_file());
    return data;
}

bool can_load_symbols() {
    return true;
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
