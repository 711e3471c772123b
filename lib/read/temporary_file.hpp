#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace d2b {

/// Whether others can open a file. One without a name is gone with the process, however that ends.
enum class FileName { kept, none };

/// A new file that nobody else can have made; gone when this goes. Errors are OutputErrors that say what
/// could not be kept, why, and what to do.
class TemporaryFile {
  public:
    /// @param folder "": that of the configuration option CPL_TMPDIR, or the system's
    /// @param what is kept in it, for messages: "The standard input" @throws OutputError
    TemporaryFile(const std::string& folder, std::string what, FileName name);
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    /// @throws OutputError there is no room
    void append(std::span<const std::byte> bytes);
    /// Of what was appended; from any thread. @throws OutputError
    void read(std::uint64_t begin, std::span<std::byte> bytes) const;
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// "" where it has no name.
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    [[noreturn]] void fail(int error) const;

    std::string folder_;
    std::string what_;
    std::string path_;
    int file_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace d2b
