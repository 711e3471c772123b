#include "core/system/paths.hpp"

#include "core/system/windows/windows_api.hpp"

namespace d2b::system {
namespace {

/// Opens a file or folder without changing it; null if that fails.
HANDLE open_path(const std::filesystem::path& path, DWORD access) {
    const HANDLE handle =
        CreateFileW(path.c_str(), access, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                    OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    return handle == INVALID_HANDLE_VALUE ? nullptr : handle;
}

int rename(const std::filesystem::path& from, const std::filesystem::path& to, DWORD flags) {
    return MoveFileExW(from.c_str(), to.c_str(), flags) != 0 ? 0 : set_errno();
}

}  // namespace

bool make_unique_folder(std::string& pattern) {
    return try_random_names(pattern, [](const std::filesystem::path& path) {
        return CreateDirectoryW(path.c_str(), nullptr) != 0;
    });
}

int rename_to_free_name(const std::filesystem::path& from, const std::filesystem::path& to) {
    return rename(from, to, MOVEFILE_WRITE_THROUGH);
}

int exchange(const std::filesystem::path&, const std::filesystem::path&) {
    return ENOSYS;
}

bool is_unsupported(int error) {
    return error == ENOSYS;
}

int replace(const std::filesystem::path& from, const std::filesystem::path& to) {
    return rename(from, to, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH);
}

int sync(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        return 0;  // MOVEFILE_WRITE_THROUGH has forced its names to disk
    const HANDLE file = open_path(path, GENERIC_WRITE);
    if (file == nullptr)
        return set_errno();
    const int result = FlushFileBuffers(file) != 0 ? 0 : set_errno();
    CloseHandle(file);
    return result;
}

int write_refusal(const std::filesystem::path& path) {
    const DWORD attributes = GetFileAttributesW(path.c_str());
    if (attributes == INVALID_FILE_ATTRIBUTES)
        return set_errno();
    const bool folder = (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
    return !folder && (attributes & FILE_ATTRIBUTE_READONLY) != 0 ? EACCES : 0;
}

std::string stamp_of(const std::filesystem::path& path) {
    const HANDLE file = open_path(path, FILE_READ_ATTRIBUTES);
    BY_HANDLE_FILE_INFORMATION about{};
    if (file == nullptr)
        return {};
    const bool known = GetFileInformationByHandle(file, &about) != 0;
    CloseHandle(file);
    const auto number = [](DWORD high, DWORD low) {
        constexpr int word = 32;
        return std::to_string((std::uint64_t{high} << word) | low);
    };
    return known ? number(about.nFileIndexHigh, about.nFileIndexLow) + '|' +
                       number(about.nFileSizeHigh, about.nFileSizeLow) + '|' +
                       number(about.ftLastWriteTime.dwHighDateTime, about.ftLastWriteTime.dwLowDateTime)
                 : std::string();
}

OpenFolder::OpenFolder(const std::filesystem::path& folder) {
    std::error_code error;
    open_ = std::filesystem::is_directory(folder, error);
    if (!open_)
        errno = ENOTDIR;
}

OpenFolder::~OpenFolder() = default;

bool OpenFolder::needs_sync_of_each_file() {
    return true;
}

bool OpenFolder::sync_file_system() const {
    return true;
}

}  // namespace d2b::system
