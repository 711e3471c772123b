#include "core/system/file.hpp"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace d2b::system {
namespace {

int descriptor_of(std::intptr_t handle) {
    return static_cast<int>(handle);
}

}  // namespace

File::File(const std::filesystem::path& path, Mode mode)
    : handle_(::open(path.c_str(), (mode == Mode::read ? O_RDONLY : O_WRONLY | O_CREAT | O_TRUNC) | O_CLOEXEC,
                     0666)) {}

File::File(std::string& pattern, Name name) : handle_(::mkostemp(pattern.data(), O_CLOEXEC)) {
    if (is_open() && name == Name::none)
        ::unlink(pattern.c_str());
}

File::~File() {
    if (is_open())
        ::close(descriptor_of(handle_));
}

std::uint64_t File::size() const {
    struct stat status {};
    return ::fstat(descriptor_of(handle_), &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

void File::disable_read_ahead() const {
#ifdef POSIX_FADV_RANDOM
    // Only a hint, so errors do not matter.
    (void)::posix_fadvise(descriptor_of(handle_), 0, 0, POSIX_FADV_RANDOM);
#endif
}

bool File::read(std::uint64_t begin, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t n =
            ::pread(descriptor_of(handle_), bytes.data(), bytes.size(), static_cast<off_t>(begin));
        if (n < 0 && errno == EINTR)
            continue;
        if (n == 0)
            errno = EIO;  // the file ends before
        if (n <= 0)
            return false;
        begin += static_cast<std::uint64_t>(n);
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return true;
}

bool File::write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t n = ::write(descriptor_of(handle_), bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            return false;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return true;
}

std::size_t File::write_at(std::uint64_t begin, std::span<const std::byte> bytes) const {
    ssize_t n = -1;
    do
        n = ::pwrite(descriptor_of(handle_), bytes.data(), bytes.size(), static_cast<off_t>(begin));
    while (n < 0 && errno == EINTR);
    if (n == 0)
        errno = ENOSPC;
    return n > 0 ? static_cast<std::size_t>(n) : 0;
}

bool File::sync() const {
    return ::fsync(descriptor_of(handle_)) == 0;
}

}  // namespace d2b::system
