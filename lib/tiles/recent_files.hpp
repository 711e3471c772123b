#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "tiles/open_file.hpp"

namespace d2b {

/// Files that are read a little of each by turns: those that were read last stay open, as many as any system
/// lets a process have. From any thread.
class RecentFiles {
  public:
    /// What the system reads beside what it is asked for.
    enum class ReadAhead : std::uint8_t { usual, none };

    /// @param most that stay open
    explicit RecentFiles(ReadAhead ahead = ReadAhead::usual, std::size_t most = 256)
        : ahead_(ahead), most_(most) {}

    /// To be read. Where it could not be opened errno says why.
    [[nodiscard]] std::shared_ptr<const OpenFile> open(const std::filesystem::path& path);

  private:
    struct Recent {
        std::string path;
        std::shared_ptr<const OpenFile> file;
    };
    ReadAhead ahead_;
    std::size_t most_;
    std::mutex mutex_;
    std::list<Recent> files_;  ///< the one that was read last comes first
    std::unordered_map<std::string, std::list<Recent>::iterator> places_;  ///< by path
};

}  // namespace d2b
