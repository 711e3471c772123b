#include "write/file_moves.hpp"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace d2b {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_errno(int number) {
    throw std::system_error(number, std::generic_category());
}

/// Some file systems and kernels know no flags for renames.
bool not_supported(int number) {
    return number == EINVAL || number == ENOSYS || number == ENOTSUP;
}

int rename_with(const fs::path& from, const fs::path& to, [[maybe_unused]] bool exchanging) {
#ifdef RENAME_EXCHANGE
    return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(),
                       exchanging ? RENAME_EXCHANGE : RENAME_NOREPLACE);
#else
    errno = ENOSYS;
    return -1;
#endif
}

}  // namespace

FileMoves::~FileMoves() {
    std::error_code ignored;
    for (auto move = done_.rbegin(); move != done_.rend(); ++move)
        fs::rename(move->second, move->first, ignored);
}

void FileMoves::move(const fs::path& from, const fs::path& to) {
    done_.reserve(done_.size() + 1);
    if (rename_with(from, to, false) != 0) {
        if (!not_supported(errno))
            throw_errno(errno);
        if (fs::exists(fs::symlink_status(to)))
            throw_errno(EEXIST);
        fs::rename(from, to);
    }
    done_.emplace_back(from, to);
}

void exchange(const fs::path& a, const fs::path& b, const fs::path& spare) {
    if (rename_with(a, b, true) == 0)
        return;
    if (!not_supported(errno))
        throw_errno(errno);
    FileMoves moves;
    moves.move(b, spare);
    moves.move(a, b);
    moves.keep();
}

void sync_to_disk(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        throw_errno(errno);
    const int result = ::fsync(file);
    const int number = errno;
    ::close(file);
    // Special file systems have nothing to force.
    if (result != 0 && number != EINVAL && number != EROFS)
        throw_errno(number);
}

}  // namespace d2b
