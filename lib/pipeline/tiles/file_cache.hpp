#pragma once

#include <cstddef>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "core/system/file.hpp"

namespace d2b::tiles {

/// LRU cache of open files, for reading many files in small alternating pieces. It stays below the usual
/// limit of open files per process. Disables read-ahead, because files are read in turns and the cached pages
/// would be evicted before use. Thread-safe.
class FileHandleCache {
  public:
    /// @param most largest number of open files
    explicit FileHandleCache(std::size_t most = 256) : most_(most) {}

    /// Opens a file for reading. If it cannot be opened, errno gives the reason.
    [[nodiscard]] std::shared_ptr<const system::File> open(const std::filesystem::path& path);

  private:
    struct Recent {
        std::string path;
        std::shared_ptr<const system::File> file;
    };
    std::size_t most_;
    std::mutex mutex_;
    std::list<Recent> files_;                                              ///< most recently used first
    std::unordered_map<std::string, std::list<Recent>::iterator> places_;  ///< by path
};

}  // namespace d2b::tiles
