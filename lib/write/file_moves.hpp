#pragma once

#include <filesystem>
#include <vector>

namespace d2b {

/// Renames that can be taken back, and are, the last one first, unless all of them are kept.
class FileMoves {
  public:
    FileMoves() = default;
    FileMoves(const FileMoves&) = delete;
    FileMoves& operator=(const FileMoves&) = delete;
    ~FileMoves();

    /// Replaces nothing: a file that has turned up at `to` is an error. @throws std::system_error
    void move(const std::filesystem::path& from, const std::filesystem::path& to);
    /// Puts `from` in the place of `to`, which is there, in one step, and keeps the old one: at `from` where
    /// the file system can exchange two names, else at `spare`, a path that does not exist. A folder takes
    /// two steps then. @throws std::system_error, and both are as they were
    void replace(const std::filesystem::path& from, const std::filesystem::path& to,
                 const std::filesystem::path& spare);
    /// @return paths that it could not bring back, each where it lies now
    [[nodiscard]] std::vector<std::filesystem::path> take_back();
    void keep() { done_.clear(); }

  private:
    struct Move {
        std::filesystem::path from;
        std::filesystem::path to;
        bool exchanged = false;  ///< what stood at `to` is at `from` now
    };
    /// @return whether it is done
    static bool undo(const Move& move);

    std::vector<Move> done_;
};

/// fsync of a file or folder. @throws std::system_error
void sync_to_disk(const std::filesystem::path& path);

}  // namespace d2b
