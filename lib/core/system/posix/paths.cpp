#include "core/system/paths.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace d2b::system {

bool make_unique_folder(std::string& pattern) {
    return ::mkdtemp(pattern.data()) != nullptr;
}

int rename_to_free_name([[maybe_unused]] const std::filesystem::path& from,
                        [[maybe_unused]] const std::filesystem::path& to) {
#ifdef RENAME_NOREPLACE
    return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0 ? 0 : errno;
#elif defined(RENAME_EXCL)
    return ::renamex_np(from.c_str(), to.c_str(), RENAME_EXCL) == 0 ? 0 : errno;
#else
    return ENOSYS;
#endif
}

int exchange([[maybe_unused]] const std::filesystem::path& one,
             [[maybe_unused]] const std::filesystem::path& other) {
#ifdef RENAME_EXCHANGE
    return ::renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0 ? 0 : errno;
#elif defined(RENAME_SWAP)
    return ::renamex_np(one.c_str(), other.c_str(), RENAME_SWAP) == 0 ? 0 : errno;
#else
    return ENOSYS;
#endif
}

bool is_unsupported(int error) {
    return error == EINVAL || error == ENOSYS || error == ENOTSUP;
}

int replace(const std::filesystem::path& from, const std::filesystem::path& to) {
    return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

int sync(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return errno;
    const int result = ::fsync(file);
    const int error = errno;
    ::close(file);
    // Special file systems do not support fsync.
    return result != 0 && error != EINVAL && error != EROFS ? error : 0;
}

int write_refusal(const std::filesystem::path& path) {
    return ::access(path.c_str(), W_OK) == 0 ? 0 : errno;
}

std::string stamp_of(const std::filesystem::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
        return {};
#ifdef __APPLE__
    const timespec& changed = status.st_mtimespec;
#else
    const timespec& changed = status.st_mtim;
#endif
    return std::to_string(status.st_ino) + '|' + std::to_string(status.st_size) + '|' +
           std::to_string(changed.tv_sec) + '.' + std::to_string(changed.tv_nsec);
}

OpenFolder::OpenFolder(const std::filesystem::path& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    open_ = descriptor_ >= 0;
}

OpenFolder::~OpenFolder() {
    if (open_)
        ::close(descriptor_);
}

bool OpenFolder::needs_sync_of_each_file() {
#ifdef __linux__
    return false;
#else
    return true;
#endif
}

bool OpenFolder::sync_file_system() const {
#ifdef __linux__
    return ::syncfs(descriptor_) == 0;
#else
    return ::fsync(descriptor_) == 0;  // the names alone
#endif
}

}  // namespace d2b::system
