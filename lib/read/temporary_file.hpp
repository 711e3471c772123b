#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace d2b {

/// Decides if other processes can open a file. An unnamed file vanishes with the process, however that ends.
enum class FileName { kept, none };

/// Exclusively created file, removed by the destructor. Errors are OutputErrors that name the data, the
/// reason and a remedy.
class TemporaryFile {
  public:
    /// @param folder "": configuration option CPL_TMPDIR, or the system's
    /// @param what data it holds, for messages: "The standard input" @throws OutputError
    TemporaryFile(const std::string& folder, std::string what, FileName name);
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    /// @throws OutputError if there is no room
    void append(std::span<const std::byte> bytes);
    /// Reads appended bytes. Thread-safe. @throws OutputError
    void read(std::uint64_t begin, std::span<std::byte> bytes) const;
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// "" for an unnamed file.
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
