#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace d2b {

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
    void expect_no_order() const;
    /// Reads all bytes at a position. Thread-safe. @return true if the file has that many
    [[nodiscard]] bool read(std::uint64_t begin, std::span<std::byte> bytes) const;
    /// @return true if all bytes were written; otherwise errno gives the reason
    [[nodiscard]] bool write(std::span<const std::byte> bytes) const;
    [[nodiscard]] bool sync() const;

  private:
    int file_;
};

}  // namespace d2b
