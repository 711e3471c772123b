#include "read/temporary_file.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <span>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"

namespace d2b::reading {
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

bool is_standard_input(std::string_view source) {
    return source.starts_with("/vsistdin/") || source.starts_with("/vsistdin?");
}

StandardInputCopy::StandardInputCopy(const std::string& source)
    : file_("", "The standard input", FileName::kept) {
    constexpr std::size_t chunk = std::size_t{1} << 20;
    const GdalMessages messages;
    const GdalOwner<VSILFILE*, VSIFCloseL> from(VSIFOpenL(source.c_str(), "rb"));
    if (!from)
        throw InputError("The standard input cannot be read: " + messages.reason() + ".");
    std::vector<std::byte> buffer(chunk);
    while (const std::size_t got = VSIFReadL(buffer.data(), 1, chunk, from.get()))
        file_.append(std::span(buffer).first(got));
    if (file_.size() == 0)
        throw InputError("The standard input is empty; pipe a raster into it or give a file.");
}

std::unique_ptr<StandardInputCopy> copy_standard_input(const std::string& source) {
    return is_standard_input(source) ? std::make_unique<StandardInputCopy>(source) : nullptr;
}

}  // namespace d2b::reading
