// Preloaded into the tool: lets calls that touch some files fail, the nth and, unless it says once, all that
// follow.
//   D2B_FAULT=<kind>:<n>:<error>     n = 0 fails never
//     kind   write     data that go out
//            sync      data that are to reach the disk
//            truncate  changes of a file's size
//            names     files that are made, renamed or removed
//            renames   of these alone
//            change    all of these
//            read      data that come in
//            net       there is no network, and who asks for it is counted
//     error  EIO, ENOSPC, EDQUOT; EIO-once, ENOSPC-once: the nth call alone, as on a server that is away for
//     a
//            moment; short: half of it is done, as a signal may have it; short-ENOSPC: half of it, nothing
//            after; kill: the process is killed
//   D2B_FAULT_PATH=<part of the paths that count>
//   D2B_FAULT_COUNT=<file that gets the number of calls that were counted, at the end>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <netdb.h>
#include <string>
#include <sys/sendfile.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

struct Plan {
    std::string kind;
    long nth = 0;
    int error = EIO;
    bool is_short = false;
    bool once = false;
    bool kills = false;
    std::string path;
};

int number_of(const std::string& error) {
    if (error.find("ENOSPC") != std::string::npos)
        return ENOSPC;
    return error.find("EDQUOT") != std::string::npos ? EDQUOT : EIO;
}

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
        const std::string error = text.substr(second + 1);
        result.kind = text.substr(0, first);
        result.nth = std::stol(text.substr(first + 1, second - first - 1));
        result.is_short = error.starts_with("short");
        result.kills = error == "kill";
        result.once = error == "short" || error.ends_with("-once");
        result.error = number_of(error);
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

/// Halves only divisible calls: the others go on.
Fate fate_of_next(bool divisible) {
    const Plan& p = plan();
    const long call = ++calls;
    if (p.nth == 0 || call < p.nth || (p.once && call != p.nth))
        return Fate::goes_on;
    if (p.kills)
        std::raise(SIGKILL);
    if (p.is_short && call == p.nth)
        return divisible ? Fate::half : Fate::goes_on;
    errno = p.error;
    return Fate::fails;
}

bool counts(const char* kind) {
    const std::string& wanted = plan().kind;
    return wanted == kind || (wanted == "change" && std::strcmp(kind, "read") != 0) ||
           (wanted == "names" && std::strcmp(kind, "renames") == 0);
}

Fate fate(const char* kind, int descriptor) {
    if (!counts(kind))
        return Fate::goes_on;
    const int saved = errno;
    char path[4096] = "";
    const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
    const ssize_t length = readlink(link.c_str(), path, sizeof path - 1);
    errno = saved;
    if (length < 0 ||
        std::string(path, static_cast<std::size_t>(length)).find(plan().path) == std::string::npos)
        return Fate::goes_on;
    return fate_of_next(std::strcmp(kind, "write") == 0 || std::strcmp(kind, "read") == 0);
}

bool fails(const char* kind, int descriptor) {
    return fate(kind, descriptor) == Fate::fails;
}

/// A path that is not absolute counts where the folder that the program works in does.
bool fails(const char* kind, const char* path) {
    if (!counts(kind))
        return false;
    std::string whole = path;
    char folder[4096] = "";
    if (path[0] != '/' && getcwd(folder, sizeof folder) != nullptr)
        whole = std::string(folder) + '/' + path;
    return whole.find(plan().path) != std::string::npos && fate_of_next(false) == Fate::fails;
}

/// Lets calls that remove a file succeed on a full disk, because they need no room.
bool removal_fails(bool fails) {
    return fails && plan().error == EIO;
}

template <typename Function>
Function real(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::size_t part(Fate f, std::size_t n) {
    return f == Fate::half && n > 1 ? n / 2 : n;
}

using Open = int (*)(const char*, int, ...);

int open_with(Open next, const char* path, int flags, mode_t mode) {
    return (flags & O_CREAT) != 0 && fails("names", path) ? -1 : next(path, flags, mode);
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* data, size_t size) {
    static const auto next = real<ssize_t (*)(int, const void*, size_t)>("write");
    const Fate f = fate("write", descriptor);
    return f == Fate::fails ? -1 : next(descriptor, data, part(f, size));
}

ssize_t pwrite64(int descriptor, const void* data, size_t size, off64_t at) {
    static const auto next = real<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
    const Fate f = fate("write", descriptor);
    return f == Fate::fails ? -1 : next(descriptor, data, part(f, size), at);
}

ssize_t pwrite(int descriptor, const void* data, size_t size, off_t at) {
    return pwrite64(descriptor, data, size, at);
}

ssize_t writev(int descriptor, const struct iovec* pieces, int count) {
    static const auto next = real<ssize_t (*)(int, const struct iovec*, int)>("writev");
    const Fate f = fate("write", descriptor);
    return f == Fate::fails ? -1
                            : next(descriptor, pieces, static_cast<int>(part(f, static_cast<size_t>(count))));
}

ssize_t sendfile(int out, int in, off_t* at, size_t size) {
    static const auto next = real<ssize_t (*)(int, int, off_t*, size_t)>("sendfile");
    const Fate f = fate("write", out);
    return f == Fate::fails ? -1 : next(out, in, at, part(f, size));
}

ssize_t read(int descriptor, void* data, size_t size) {
    static const auto next = real<ssize_t (*)(int, void*, size_t)>("read");
    const Fate f = fate("read", descriptor);
    return f == Fate::fails ? -1 : next(descriptor, data, part(f, size));
}

ssize_t pread64(int descriptor, void* data, size_t size, off64_t at) {
    static const auto next = real<ssize_t (*)(int, void*, size_t, off64_t)>("pread64");
    const Fate f = fate("read", descriptor);
    return f == Fate::fails ? -1 : next(descriptor, data, part(f, size), at);
}

// Streams call the system from inside of the C library, where nothing can be put in between.
size_t fwrite(const void* data, size_t size, size_t count, std::FILE* file) {
    static const auto next = real<size_t (*)(const void*, size_t, size_t, std::FILE*)>("fwrite");
    const Fate f = fate("write", fileno(file));
    return f == Fate::fails ? 0 : next(data, size, part(f, count), file);
}

size_t fread(void* data, size_t size, size_t count, std::FILE* file) {
    static const auto next = real<size_t (*)(void*, size_t, size_t, std::FILE*)>("fread");
    const Fate f = fate("read", fileno(file));
    return f == Fate::fails ? 0 : next(data, size, part(f, count), file);
}

int fflush(std::FILE* file) {
    static const auto next = real<int (*)(std::FILE*)>("fflush");
    return file != nullptr && fails("write", fileno(file)) ? EOF : next(file);
}

int fclose(std::FILE* file) {
    static const auto next = real<int (*)(std::FILE*)>("fclose");
    const bool failed = fails("write", fileno(file));
    const int error = errno;
    const int result = next(file);
    if (failed)
        errno = error;
    return failed ? EOF : result;
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
    return fails("sync", descriptor) ? -1 : next(descriptor);
}

int fdatasync(int descriptor) {
    static const auto next = real<int (*)(int)>("fdatasync");
    return fails("sync", descriptor) ? -1 : next(descriptor);
}

int syncfs(int descriptor) {
    static const auto next = real<int (*)(int)>("syncfs");
    return fails("sync", descriptor) ? -1 : next(descriptor);
}

int ftruncate64(int descriptor, off64_t size) {
    static const auto next = real<int (*)(int, off64_t)>("ftruncate64");
    return fails("truncate", descriptor) ? -1 : next(descriptor, size);
}

int ftruncate(int descriptor, off_t size) {
    return ftruncate64(descriptor, size);
}

int truncate(const char* path, off_t size) {
    static const auto next = real<int (*)(const char*, off_t)>("truncate");
    return fails("truncate", path) ? -1 : next(path, size);
}

int unlink(const char* path) {
    static const auto next = real<int (*)(const char*)>("unlink");
    return removal_fails(fails("names", path)) ? -1 : next(path);
}

int unlinkat(int folder, const char* path, int flags) {
    static const auto next = real<int (*)(int, const char*, int)>("unlinkat");
    const bool counted = folder == AT_FDCWD ? fails("names", path) : fails("names", folder);
    return removal_fails(counted) ? -1 : next(folder, path, flags);
}

int remove(const char* path) {
    static const auto next = real<int (*)(const char*)>("remove");
    return removal_fails(fails("names", path)) ? -1 : next(path);
}

int rmdir(const char* path) {
    static const auto next = real<int (*)(const char*)>("rmdir");
    return removal_fails(fails("names", path)) ? -1 : next(path);
}

int mkdir(const char* path, mode_t mode) {
    static const auto next = real<int (*)(const char*, mode_t)>("mkdir");
    return fails("names", path) ? -1 : next(path, mode);
}

char* mkdtemp(char* pattern) {
    static const auto next = real<char* (*)(char*)>("mkdtemp");
    return fails("names", pattern) ? nullptr : next(pattern);
}

int rename(const char* from, const char* to) {
    static const auto next = real<int (*)(const char*, const char*)>("rename");
    return fails("renames", from) ? -1 : next(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
    static const auto next = real<int (*)(int, const char*, int, const char*, unsigned)>("renameat2");
    return fails("renames", from) ? -1 : next(from_folder, from, to_folder, to, flags);
}

int open64(const char* path, int flags, ...) {
    static const auto next = real<Open>("open64");
    std::va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open_with(next, path, flags, mode);
}

int open(const char* path, int flags, ...) {
    static const auto next = real<Open>("open");
    std::va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open_with(next, path, flags, mode);
}

std::FILE* fopen64(const char* path, const char* mode) {
    static const auto next = real<std::FILE* (*)(const char*, const char*)>("fopen64");
    return mode[0] != 'r' && fails("names", path) ? nullptr : next(path, mode);
}
}
