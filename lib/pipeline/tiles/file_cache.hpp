#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "core/system/file.hpp"

namespace d2b::tiles {

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
    [[nodiscard]] std::shared_ptr<const system::File> open(const std::filesystem::path& path);

  private:
    struct Recent {
        std::string path;
        std::shared_ptr<const system::File> file;
    };
    ReadAhead ahead_;
    std::size_t most_;
    std::mutex mutex_;
    std::list<Recent> files_;                                              ///< most recently used first
    std::unordered_map<std::string, std::list<Recent>::iterator> places_;  ///< by path
};

}  // namespace d2b::tiles
