#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <unordered_map>

namespace d2b::tiles {

/// Open file descriptor. If is_open() is false, errno gives the reason.
class OpenFile {
  public:
    /// @param flags of open(2)
    OpenFile(const std::filesystem::path& path, int flags);
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile();

    [[nodiscard]] bool is_open() const { return file_ >= 0; }
    [[nodiscard]] std::uint64_t size() const;
    /// Disables read-ahead.
    void disable_read_ahead() const;
    /// Reads all bytes at a position. Thread-safe. @return true if the file has that many
    [[nodiscard]] bool read(std::uint64_t begin, std::span<std::byte> bytes) const;
    /// @return true if all bytes were written; otherwise errno gives the reason
    [[nodiscard]] bool write(std::span<const std::byte> bytes) const;
    [[nodiscard]] bool sync() const;

  private:
    int file_;
};

/// LRU cache of open files, for reading many files in small alternating pieces. It stays below the usual
/// limit of open files per process. Thread-safe.
class FileHandleCache {
  public:
    /// Read-ahead of the operating system.
    enum class ReadAhead : std::uint8_t { usual, none };

    /// @param most largest number of open files
    explicit FileHandleCache(ReadAhead ahead = ReadAhead::usual, std::size_t most = 256)
        : ahead_(ahead), most_(most) {}

    /// Opens a file for reading. If it cannot be opened, errno gives the reason.
    [[nodiscard]] std::shared_ptr<const OpenFile> open(const std::filesystem::path& path);

  private:
    struct Recent {
        std::string path;
        std::shared_ptr<const OpenFile> file;
    };
    ReadAhead ahead_;
    std::size_t most_;
    std::mutex mutex_;
    std::list<Recent> files_;                                              ///< most recently used first
    std::unordered_map<std::string, std::list<Recent>::iterator> places_;  ///< by path
};

}  // namespace d2b::tiles
