#pragma once

#include <filesystem>
#include <vector>

namespace d2b {

/// Renames files and undoes all renames in reverse order on destruction, unless keep() is called.
class FileMoves {
  public:
    FileMoves() = default;
    FileMoves(const FileMoves&) = delete;
    FileMoves& operator=(const FileMoves&) = delete;
    ~FileMoves();

    /// Never replaces a file. @throws std::system_error if `to` exists or the rename fails
    void move(const std::filesystem::path& from, const std::filesystem::path& to);
    /// Replaces the existing `to` atomically and keeps the old file: at `from` if the file system can
    /// exchange names, otherwise at `spare`, a path that does not exist. A folder then takes two steps.
    /// @throws std::system_error; both are then unchanged
    void replace(const std::filesystem::path& from, const std::filesystem::path& to,
                 const std::filesystem::path& spare);
    /// @return present paths of files that could not be restored
    [[nodiscard]] std::vector<std::filesystem::path> take_back();
    void keep() { done_.clear(); }

  private:
    struct Move {
        std::filesystem::path from;
        std::filesystem::path to;
        bool exchanged = false;  ///< old `to` is now at `from`
    };
    /// @return true if undone
    static bool undo(const Move& move);

    std::vector<Move> done_;
};

/// Calls fsync for a file or folder. @throws std::system_error
void sync_to_disk(const std::filesystem::path& path);

}  // namespace d2b
