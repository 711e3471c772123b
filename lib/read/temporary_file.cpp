#include "read/temporary_file.hpp"

#include <cerrno>
#include <filesystem>
#include <system_error>
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
    file_.emplace(path, name);
    if (!file_->is_open())
        fail(errno);
    if (name == FileName::kept)
        path_ = std::move(path);
}

TemporaryFile::~TemporaryFile() {
    file_.reset();
    std::error_code ignored;
    if (!path_.empty())
        std::filesystem::remove(path_, ignored);
}

void TemporaryFile::fail(int error) const {
    throw OutputError(what_ + " cannot be kept in a temporary file in '" + folder_ + "': " +
                      std::generic_category().message(error) + "; set CPL_TMPDIR to a folder with room.");
}

void TemporaryFile::append(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const std::size_t written = file_->write_at(size_, bytes);
        if (written == 0)
            fail(errno);
        size_ += written;
        bytes = bytes.subspan(written);
    }
}

void TemporaryFile::read(std::uint64_t begin, std::span<std::byte> bytes) const {
    if (!file_->read(begin, bytes))
        fail(errno);
}

bool is_standard_input(std::string_view source) {
    return source.starts_with("/vsistdin/") || source.starts_with("/vsistdin?");
}

std::unique_ptr<TemporaryFile> copy_standard_input(const std::string& source) {
    if (!is_standard_input(source))
        return nullptr;
    constexpr std::size_t chunk = std::size_t{1} << 20;
    auto copy = std::make_unique<TemporaryFile>("", "The standard input", FileName::kept);
    const GdalMessages messages;
    const GdalOwner<VSILFILE*, VSIFCloseL> from(VSIFOpenL(source.c_str(), "rb"));
    if (!from)
        throw InputError("The standard input cannot be read: " + messages.reason() + ".");
    std::vector<std::byte> buffer(chunk);
    while (const std::size_t got = VSIFReadL(buffer.data(), 1, chunk, from.get()))
        copy->append(std::span(buffer).first(got));
    if (copy->size() == 0)
        throw InputError("The standard input is empty; pipe a raster into it or give a file.");
    return copy;
}

}  // namespace d2b::reading
