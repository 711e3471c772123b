#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace d2b::system {

/// Creates a folder of a new name. @param pattern path that ends in XXXXXX, which are replaced
/// @return false if it cannot be created; errno gives the reason
[[nodiscard]] bool make_unique_folder(std::string& pattern);

/// Renames a file or folder, but replaces nothing. @return 0, or the error number: EEXIST, or one that
/// is_unsupported()
[[nodiscard]] int rename_to_free_name(const std::filesystem::path& from, const std::filesystem::path& to);

/// Swaps two files or folders in one step. @return 0, or the error number
[[nodiscard]] int exchange(const std::filesystem::path& one, const std::filesystem::path& other);

/// True if the system or the file system does not have such a way to rename.
[[nodiscard]] bool is_unsupported(int error);

/// Replaces a file in one step. @return 0, or the error number
[[nodiscard]] int replace(const std::filesystem::path& from, const std::filesystem::path& to);

/// Forces a file, or the names in a folder, to disk. @return 0, or the error number
[[nodiscard]] int sync(const std::filesystem::path& path);

/// @return 0 if the file can be written to, otherwise the error number
[[nodiscard]] int write_refusal(const std::filesystem::path& path);

/// Text that changes if the file is replaced or written to; "" if there is no such file.
[[nodiscard]] std::string stamp_of(const std::filesystem::path& path);

/// Folder whose whole file system can be forced to disk, which is quicker than one file after the other.
class OpenFolder {
  public:
    explicit OpenFolder(const std::filesystem::path& folder);
    OpenFolder(const OpenFolder&) = delete;
    OpenFolder& operator=(const OpenFolder&) = delete;
    ~OpenFolder();

    /// If it is false, errno gives the reason.
    [[nodiscard]] bool is_open() const { return open_; }
    /// True if the system has no such call, so that each file must be synced.
    [[nodiscard]] static bool needs_sync_of_each_file();
    /// @return false if it fails; errno gives the reason
    [[nodiscard]] bool sync_file_system() const;

  private:
    bool open_ = false;
    int descriptor_ = -1;
};

}  // namespace d2b::system
