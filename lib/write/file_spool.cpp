#include "write/file_spool.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "dem2buildings/error.hpp"
#include "read/temporary_folder.hpp"

namespace d2b {
namespace {

/// A new file that nobody else can open; -1 where that fails.
int nameless_file(const std::string& folder) {
    std::string path = (std::filesystem::path(folder) / "dem2buildings_XXXXXX").string();
    const int file = mkostemp(path.data(), O_CLOEXEC);
    if (file >= 0)
        unlink(path.c_str());
    return file;
}

}  // namespace

FileSpool::FileSpool(std::string folder, std::size_t in_memory)
    : folder_(folder.empty() ? temporary_folder() : std::move(folder)), most_in_memory_(in_memory) {}

FileSpool::~FileSpool() {
    if (file_ >= 0)
        close(file_);
}

void FileSpool::fail(int error) const {
    throw OutputError("What is waiting to be written cannot be kept in a temporary file in '" + folder_ +
                      "': " + std::generic_category().message(error) +
                      "; set CPL_TMPDIR to a folder with room.");
}

std::uint64_t FileSpool::append(std::span<const std::byte> bytes) {
    const std::scoped_lock lock(mutex_);
    const std::uint64_t begin = in_file_ + memory_.size();
    memory_.insert(memory_.end(), bytes.begin(), bytes.end());
    if (memory_.size() > (file_ < 0 ? most_in_memory_ : bytes_a_write))
        flush();
    return begin;
}

void FileSpool::flush() {
    if (file_ < 0 && (file_ = nameless_file(folder_)) < 0)
        fail(errno);
    std::span<const std::byte> rest(memory_);
    while (!rest.empty()) {
        const ssize_t written = pwrite(file_, rest.data(), rest.size(), static_cast<off_t>(in_file_));
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            fail(written < 0 ? errno : ENOSPC);
        in_file_ += static_cast<std::uint64_t>(written);
        rest = rest.subspan(static_cast<std::size_t>(written));
    }
    memory_ = {};
    memory_.reserve(bytes_a_write);
}

void FileSpool::read(std::uint64_t begin, std::span<std::byte> bytes) const {
    {
        const std::scoped_lock lock(mutex_);
        if (begin >= in_file_) {
            std::copy_n(memory_.begin() + static_cast<std::ptrdiff_t>(begin - in_file_), bytes.size(),
                        bytes.begin());
            return;
        }
    }
    // What was appended in one piece is in the file whole, and the file only grows.
    while (!bytes.empty()) {
        const ssize_t got = pread(file_, bytes.data(), bytes.size(), static_cast<off_t>(begin));
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            fail(got < 0 ? errno : EIO);
        begin += static_cast<std::uint64_t>(got);
        bytes = bytes.subspan(static_cast<std::size_t>(got));
    }
}

}  // namespace d2b
