#include "core/system/streams.hpp"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace d2b::system {
namespace {

/// Allocates disk space without changing the length of the file.
bool has_space_in_file(int file, const struct stat& status, std::uint64_t bytes) {
    const int flags = ::fcntl(file, F_GETFL);
    const off_t at = (flags & O_APPEND) != 0 ? status.st_size : ::lseek(file, 0, SEEK_CUR);
    struct rlimit limit {};
    if (at < 0)
        return true;
    if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
        static_cast<rlim_t>(at) + bytes > limit.rlim_cur)
        return false;
#ifdef FALLOC_FL_KEEP_SIZE
    if (::fallocate(file, FALLOC_FL_KEEP_SIZE, at, static_cast<off_t>(bytes)) != 0)
        return errno != ENOSPC && errno != EDQUOT && errno != EFBIG && errno != EIO;
#endif
    return true;
}

}  // namespace

void prepare_streams() {
    // Opened the wrong way round, because reading from or writing to a stream that was closed must fail.
    for (const int stream : std::array{STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
            static_cast<void>(::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

bool are_terminals() {
    return ::isatty(STDOUT_FILENO) != 0 && ::isatty(STDERR_FILENO) != 0;
}

std::FILE* divert_stdout() {
    const int copy = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (copy < 0)
        return nullptr;
    std::FILE* const file = ::fdopen(copy, "w");
    if (file != nullptr && ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
        static_cast<void>(std::fclose(file));
        return nullptr;
    }
    return file;
}

void restore_stdout(std::FILE* copy) {
    static_cast<void>(::dup2(::fileno(copy), STDOUT_FILENO));
}

bool has_space(std::FILE* stream, std::uint64_t bytes) {
    const int file = ::fileno(stream);
    const int flags = ::fcntl(file, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY)
        return false;
    struct stat status {};
    if (::fstat(file, &status) != 0)
        return false;
    if (S_ISREG(status.st_mode))
        return has_space_in_file(file, status, bytes);
    // Detects pipes without a reader and devices that accept no data.
    struct pollfd ready {
        file, POLLOUT, 0
    };
    if (::poll(&ready, 1, 0) > 0 && (ready.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0)
        return false;
    return !S_ISCHR(status.st_mode) || ::write(file, "", 0) == 0;
}

}  // namespace d2b::system
