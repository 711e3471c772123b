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

/// True if the file system or kernel does not support flags of renameat2.
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
    static_cast<void>(take_back());
}

bool FileMoves::undo(const Move& move) {
    if (move.exchanged)
        return rename_with(move.from, move.to, true) == 0;
    std::error_code error;
    fs::rename(move.to, move.from, error);
    return !error;
}

std::vector<fs::path> FileMoves::take_back() {
    std::vector<fs::path> left;
    for (auto move = done_.rbegin(); move != done_.rend(); ++move)
        if (!undo(*move))
            left.push_back(move->exchanged ? move->from : move->to);
    done_.clear();
    return left;
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
    done_.push_back({from, to});
}

void FileMoves::replace(const fs::path& from, const fs::path& to, const fs::path& spare) {
    done_.reserve(done_.size() + 2);
    if (rename_with(from, to, true) == 0) {
        done_.push_back({from, to, true});
        return;
    }
    if (!not_supported(errno))
        throw_errno(errno);
    if (fs::is_directory(to)) {
        FileMoves both;
        both.move(to, spare);
        both.move(from, to);
        done_.insert(done_.end(), both.done_.begin(), both.done_.end());
        both.keep();
        return;
    }
    std::error_code no_links;
    fs::create_hard_link(to, spare, no_links);
    if (no_links)
        fs::copy_file(to, spare);
    fs::rename(from, to);
    done_.push_back({to, spare});
}

void sync_to_disk(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        throw_errno(errno);
    const int result = ::fsync(file);
    const int number = errno;
    ::close(file);
    // Special file systems do not support fsync.
    if (result != 0 && number != EINVAL && number != EROFS)
        throw_errno(number);
}

}  // namespace d2b
