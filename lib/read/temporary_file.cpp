#include "read/temporary_file.hpp"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <cpl_conv.h>

#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

std::string usual_folder() {
    if (const char* folder = CPLGetConfigOption("CPL_TMPDIR", nullptr))
        return folder;
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    return error ? "/tmp" : folder.string();
}

}  // namespace

TemporaryFile::TemporaryFile(const std::string& folder, std::string what, FileName name)
    : folder_(folder.empty() ? usual_folder() : folder), what_(std::move(what)) {
    std::string path = (std::filesystem::path(folder_) / "dem2buildings_XXXXXX").string();
    file_ = mkostemp(path.data(), O_CLOEXEC);
    if (file_ < 0)
        fail(errno);
    if (name == FileName::none)
        unlink(path.c_str());
    else
        path_ = std::move(path);
}

TemporaryFile::~TemporaryFile() {
    close(file_);
    if (!path_.empty())
        unlink(path_.c_str());
}

void TemporaryFile::fail(int error) const {
    throw OutputError(what_ + " cannot be kept in a temporary file in '" + folder_ + "': " +
                      std::generic_category().message(error) + "; set CPL_TMPDIR to a folder with room.");
}

void TemporaryFile::append(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(size_));
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            fail(written < 0 ? errno : ENOSPC);
        size_ += static_cast<std::uint64_t>(written);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void TemporaryFile::read(std::uint64_t begin, std::span<std::byte> bytes) const {
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
