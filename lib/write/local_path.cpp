#include "write/local_path.hpp"

#include <system_error>

#include "dem2buildings/error.hpp"
#include "write/staging.hpp"

namespace d2b {

namespace {

namespace fs = std::filesystem;

std::string without_slashes(std::string path) {
    while (path.size() > 1 && path.back() == '/')
        path.pop_back();
    return path;
}

}  // namespace

fs::path resolved_path(const std::string& name) {
    std::error_code error;
    fs::path path = without_slashes(name);
    // std::filesystem does not follow links to files that do not exist yet.
    for (int links = 0; links < 40 && fs::is_symlink(path, error); ++links)
        path = path.parent_path() / fs::read_symlink(path, error);
    return path;
}

void check_parent_folder(const std::string& name, const fs::path& path) {
    const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::error_code error;
    const fs::file_status status = fs::status(parent, error);
    if (!fs::exists(status))
        throw OutputError("Cannot write \"" + name + "\": there is no folder \"" + parent.string() +
                          "\"; make it first.");
    if (!fs::is_directory(status))
        throw OutputError("Cannot write \"" + name + "\": \"" + parent.string() +
                          "\" is not a folder; choose another destination.");
    // Permission bits do not cover read-only and special file systems, and do not apply to root.
    const Staging trial(name, path);
}

}  // namespace d2b
