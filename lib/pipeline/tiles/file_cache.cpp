#include "pipeline/tiles/file_cache.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace d2b::tiles {

OpenFile::OpenFile(const std::filesystem::path& path, int flags)
    : file_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}

OpenFile::~OpenFile() {
    if (file_ >= 0)
        ::close(file_);
}

std::uint64_t OpenFile::size() const {
    struct stat status {};
    return ::fstat(file_, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

void OpenFile::disable_read_ahead() const {
    (void)::posix_fadvise(file_, 0, 0, POSIX_FADV_RANDOM);  // only a hint, so errors do not matter
}

bool OpenFile::read(std::uint64_t begin, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t n = ::pread(file_, bytes.data(), bytes.size(), static_cast<off_t>(begin));
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return false;
        begin += static_cast<std::uint64_t>(n);
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return true;
}

bool OpenFile::write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t n = ::write(file_, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            return false;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return true;
}

bool OpenFile::sync() const {
    return ::fsync(file_) == 0;
}

std::shared_ptr<const OpenFile> FileHandleCache::open(const std::filesystem::path& path) {
    const std::lock_guard lock(mutex_);
    if (const auto known = places_.find(path.native()); known != places_.end()) {
        files_.splice(files_.begin(), files_, known->second);
        return known->second->file;
    }
    auto file = std::make_shared<const OpenFile>(path, O_RDONLY);
    if (!file->is_open())
        return file;
    if (ahead_ == ReadAhead::none)
        file->disable_read_ahead();
    if (files_.size() >= most_) {
        places_.erase(files_.back().path);
        files_.pop_back();
    }
    files_.push_front({path.native(), file});
    places_[path.native()] = files_.begin();
    return file;
}

}  // namespace d2b::tiles
