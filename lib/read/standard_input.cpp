#include "read/spool.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"
#include "read/temporary_folder.hpp"

namespace d2b {

namespace {

/// The owner of a file that is read; closing one that is written can fail and is done by hand.
using FileOwner = GdalOwner<VSILFILE*, VSIFCloseL>;

[[noreturn]] void fail(const std::string& folder, const std::string& reason) {
    throw OutputError("The standard input cannot be kept in a temporary file in '" + folder + "': " + reason +
                      "; set CPL_TMPDIR to a folder with room.");
}

std::string reason_of(int error) {
    return std::generic_category().message(error);
}

/// Creates an empty file that nobody else can have made or can read.
std::string create_file(const std::string& folder) {
    std::string path = (std::filesystem::path(folder) / "dem2buildings_XXXXXX").string();
    const int descriptor = mkstemp(path.data());
    if (descriptor < 0)
        fail(folder, reason_of(errno));
    close(descriptor);
    return path;
}

/// @returns the number of bytes
std::size_t copy(VSILFILE* from, VSILFILE* to, const std::string& folder) {
    constexpr std::size_t chunk = std::size_t{1} << 20;
    std::vector<char> buffer(chunk);
    std::size_t total = 0;
    while (const std::size_t got = VSIFReadL(buffer.data(), 1, chunk, from)) {
        if (VSIFWriteL(buffer.data(), 1, got, to) != got)
            fail(folder, reason_of(errno));
        total += got;
    }
    return total;
}

void spool(const std::string& source, const std::string& path, const std::string& folder) {
    const GdalMessages messages;
    const FileOwner from(VSIFOpenL(source.c_str(), "rb"));
    if (!from)
        throw InputError("The standard input cannot be read: " + messages.reason() + ".");
    FileOwner to(VSIFOpenL(path.c_str(), "wb"));
    if (!to)
        fail(folder, reason_of(errno));
    if (copy(from.get(), to.get(), folder) == 0)
        throw InputError("Nothing came in on the standard input; send a raster to it or give a file.");
    if (VSIFCloseL(to.release()) != 0)
        fail(folder, reason_of(errno));
}

}  // namespace

bool is_standard_input(std::string_view source) {
    return source.starts_with("/vsistdin/") || source.starts_with("/vsistdin?");
}

SpooledInput::SpooledInput(const std::string& source) {
    const std::string folder = temporary_folder();
    path_ = create_file(folder);
    try {
        spool(source, path_, folder);
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
        throw;
    }
}

SpooledInput::~SpooledInput() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

}  // namespace d2b
