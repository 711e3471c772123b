#pragma once

#include <filesystem>
#include <utility>
#include <vector>

namespace d2b {

/// Renames that are taken back, the last one first, unless all of them are kept.
class FileMoves {
  public:
    FileMoves() = default;
    FileMoves(const FileMoves&) = delete;
    FileMoves& operator=(const FileMoves&) = delete;
    ~FileMoves();

    /// Replaces nothing: a file that has turned up at `to` is an error. @throws std::system_error
    void move(const std::filesystem::path& from, const std::filesystem::path& to);
    void keep() { done_.clear(); }

  private:
    std::vector<std::pair<std::filesystem::path, std::filesystem::path>> done_;
};

/// Lets two paths change places in one step where the file system can; else by way of `spare`, a path that
/// does not exist. @throws std::system_error, and both are as they were
void exchange(const std::filesystem::path& a, const std::filesystem::path& b,
              const std::filesystem::path& spare);

/// fsync of a file or folder. @throws std::system_error
void sync_to_disk(const std::filesystem::path& path);

}  // namespace d2b
