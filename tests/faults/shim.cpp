// Preloaded into the tool: lets reads or writes of some files fail, the nth and all that follow.
//   D2B_FAULT=<write|read|sync>:<n>:<EIO|ENOSPC|once|short>   n = 0 fails never
//   D2B_FAULT=net:0:EIO                                  there is no network, and who asks for it is counted
//   D2B_FAULT_PATH=<part of the paths that count>
//   D2B_FAULT_COUNT=<file that gets the number of calls that were counted, at the end>
// "once" lets the nth call alone fail with EIO, as a server may that is away for a moment; "short" does half
// of it, as a signal or a full quota may.
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <netdb.h>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

namespace {

struct Plan {
    std::string kind;
    long nth = 0;
    int error = EIO;
    bool is_short = false;
    bool once = false;
    std::string path;
};

const Plan& plan() {
    static const Plan made = [] {
        Plan result;
        const char* path = std::getenv("D2B_FAULT_PATH");
        result.path = path == nullptr ? "" : path;
        const char* fault = std::getenv("D2B_FAULT");
        if (fault == nullptr)
            return result;
        const std::string text = fault;
        const std::size_t first = text.find(':');
        const std::size_t second = text.find(':', first + 1);
        result.kind = text.substr(0, first);
        result.nth = std::stol(text.substr(first + 1, second - first - 1));
        result.is_short = text.substr(second + 1) == "short";
        result.once = text.substr(second + 1) == "once";
        result.error = text.substr(second + 1) == "ENOSPC" ? ENOSPC : EIO;
        return result;
    }();
    return made;
}

std::atomic<long> calls = 0;

struct Report {
    Report() = default;
    Report(const Report&) = delete;
    Report& operator=(const Report&) = delete;
    ~Report() {
        if (const char* name = std::getenv("D2B_FAULT_COUNT"))
            if (std::FILE* file = std::fopen(name, "w")) {
                std::fprintf(file, "%ld\n", calls.load());
                std::fclose(file);
            }
    }
};
const Report report;

enum class Fate { goes_on, half, fails };

Fate fate(const char* kind, int descriptor) {
    const Plan& p = plan();
    if (p.kind != kind)
        return Fate::goes_on;
    const int saved = errno;
    char path[4096] = "";
    const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
    const ssize_t length = readlink(link.c_str(), path, sizeof path - 1);
    errno = saved;
    if (length < 0 || std::string(path, static_cast<std::size_t>(length)).find(p.path) == std::string::npos)
        return Fate::goes_on;
    const long call = ++calls;
    if (p.nth == 0 || call < p.nth)
        return Fate::goes_on;
    if (p.is_short)
        return call == p.nth ? Fate::half : Fate::goes_on;
    if (p.once && call != p.nth)
        return Fate::goes_on;
    errno = p.error;
    return Fate::fails;
}

template <typename Function>
Function real(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::size_t half(std::size_t n) {
    return n > 1 ? n / 2 : n;
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* data, size_t size) {
    static const auto next = real<ssize_t (*)(int, const void*, size_t)>("write");
    const Fate f = fate("write", descriptor);
    return f == Fate::fails ? -1 : next(descriptor, data, f == Fate::half ? half(size) : size);
}

ssize_t pwrite64(int descriptor, const void* data, size_t size, off64_t at) {
    static const auto next = real<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
    const Fate f = fate("write", descriptor);
    return f == Fate::fails ? -1 : next(descriptor, data, f == Fate::half ? half(size) : size, at);
}

ssize_t read(int descriptor, void* data, size_t size) {
    static const auto next = real<ssize_t (*)(int, void*, size_t)>("read");
    const Fate f = fate("read", descriptor);
    return f == Fate::fails ? -1 : next(descriptor, data, f == Fate::half ? half(size) : size);
}

ssize_t pread64(int descriptor, void* data, size_t size, off64_t at) {
    static const auto next = real<ssize_t (*)(int, void*, size_t, off64_t)>("pread64");
    const Fate f = fate("read", descriptor);
    return f == Fate::fails ? -1 : next(descriptor, data, f == Fate::half ? half(size) : size, at);
}

// Streams call the system from inside of the C library, where nothing can be put in between.
size_t fwrite(const void* data, size_t size, size_t count, std::FILE* file) {
    static const auto next = real<size_t (*)(const void*, size_t, size_t, std::FILE*)>("fwrite");
    const Fate f = fate("write", fileno(file));
    return f == Fate::fails ? 0 : next(data, size, f == Fate::half ? half(count) : count, file);
}

size_t fread(void* data, size_t size, size_t count, std::FILE* file) {
    static const auto next = real<size_t (*)(void*, size_t, size_t, std::FILE*)>("fread");
    const Fate f = fate("read", fileno(file));
    return f == Fate::fails ? 0 : next(data, size, f == Fate::half ? half(count) : count, file);
}

int connect(int descriptor, const struct sockaddr* address, socklen_t length) {
    static const auto next = real<int (*)(int, const struct sockaddr*, socklen_t)>("connect");
    if (address->sa_family == AF_INET || address->sa_family == AF_INET6)
        if (plan().kind == "net" && ++calls > 0) {
            errno = ENETUNREACH;
            return -1;
        }
    return next(descriptor, address, length);
}

int getaddrinfo(const char* name, const char* service, const struct addrinfo* hints,
                struct addrinfo** found) {
    static const auto next =
        real<int (*)(const char*, const char*, const struct addrinfo*, struct addrinfo**)>("getaddrinfo");
    if (plan().kind == "net" && ++calls > 0)
        return EAI_FAIL;
    return next(name, service, hints, found);
}

int fsync(int descriptor) {
    static const auto next = real<int (*)(int)>("fsync");
    return fate("sync", descriptor) == Fate::goes_on ? next(descriptor) : -1;
}

int fdatasync(int descriptor) {
    static const auto next = real<int (*)(int)>("fdatasync");
    return fate("sync", descriptor) == Fate::goes_on ? next(descriptor) : -1;
}
}
