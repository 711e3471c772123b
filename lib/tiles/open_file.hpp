#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace d2b {

/// A file that is open. Where it could not be opened errno says why.
class OpenFile {
  public:
    /// @param flags of open(2)
    OpenFile(const std::filesystem::path& path, int flags);
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile();

    [[nodiscard]] bool is_open() const { return file_ >= 0; }
    [[nodiscard]] std::uint64_t size() const;
    /// Nothing is read ahead of what is asked for.
    void expect_no_order() const;
    /// From any thread. @return whether all of it was there
    [[nodiscard]] bool read(std::uint64_t begin, std::span<std::byte> bytes) const;
    /// @return whether there was room, else errno says why
    [[nodiscard]] bool write(std::span<const std::byte> bytes) const;
    [[nodiscard]] bool sync() const;

  private:
    int file_;
};

}  // namespace d2b
