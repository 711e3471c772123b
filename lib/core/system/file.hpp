#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace d2b::system {

/// Open file, closed by the destructor. If is_open() is false, or a function returns false, errno gives the
/// reason.
class File {
  public:
    /// Opens an existing file to read, or creates one to write, which empties it if it exists.
    enum class Mode : std::uint8_t { read, write };
    /// Decides if other processes can open a temporary file. An unnamed one vanishes with the process.
    enum class Name : std::uint8_t { kept, none };

    File(const std::filesystem::path& path, Mode mode);
    /// Creates a file that nobody else has opened, for reading and writing.
    /// @param pattern path that ends in XXXXXX, which are replaced
    File(std::string& pattern, Name name);
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File();

    [[nodiscard]] bool is_open() const { return handle_ != closed; }
    /// 0 if it is not known.
    [[nodiscard]] std::uint64_t size() const;
    /// Disables read-ahead, if the system can.
    void disable_read_ahead() const;
    /// Reads all bytes at a position. Thread-safe. @return true if the file has that many
    [[nodiscard]] bool read(std::uint64_t begin, std::span<std::byte> bytes) const;
    /// Writes all bytes behind those written before. @return true if all were written
    [[nodiscard]] bool write(std::span<const std::byte> bytes) const;
    /// Writes some bytes at a position. @return their number; 0 if there is an error
    [[nodiscard]] std::size_t write_at(std::uint64_t begin, std::span<const std::byte> bytes) const;
    [[nodiscard]] bool sync() const;

  private:
    static constexpr std::intptr_t closed = -1;

    std::intptr_t handle_ = closed;  ///< file descriptor, or HANDLE of Windows
};

}  // namespace d2b::system
