#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace d2b {

/// Storage for bytes that are read back later. Thread-safe.
class Spool {
  public:
    Spool() = default;
    Spool(const Spool&) = delete;
    Spool& operator=(const Spool&) = delete;
    virtual ~Spool() = default;

    /// @return their offset @throws OutputError if there is no room
    virtual std::uint64_t append(std::span<const std::byte> bytes) = 0;
    /// Reads appended bytes. @throws OutputError
    virtual void read(std::uint64_t begin, std::span<std::byte> bytes) const = 0;
};

/// Spool in memory.
class MemorySpool : public Spool {
  public:
    std::uint64_t append(std::span<const std::byte> bytes) override;
    void read(std::uint64_t begin, std::span<std::byte> bytes) const override;

  private:
    static constexpr std::size_t chunk = std::size_t{1} << 20;
    mutable std::mutex mutex_;
    std::uint64_t size_ = 0;
    std::vector<std::vector<std::byte>> chunks_;
};

/// Range of bytes in a spool.
struct SpoolEntry {
    std::uint64_t begin = 0;
    std::uint64_t size = 0;
};

namespace reading {
class TemporaryFile;
}

/// Spool that starts in memory and moves to an unnamed temporary file when it grows. The file disappears with
/// the process, even after a crash, because it has no name.
class FileSpool : public Spool {
  public:
    /// @param folder for the file; "": the configuration option CPL_TMPDIR, or the system's default
    /// @param in_memory size in bytes up to which no file is used
    explicit FileSpool(std::string folder = "", std::size_t in_memory = std::size_t{32} << 20);
    ~FileSpool() override;

    /// @throws OutputError if the file cannot be created, or there is no room for it
    std::uint64_t append(std::span<const std::byte> bytes) override;
    /// @throws OutputError
    void read(std::uint64_t begin, std::span<std::byte> bytes) const override;

  private:
    [[nodiscard]] std::uint64_t in_file() const;
    void flush();

    static constexpr std::size_t bytes_per_write = std::size_t{4} << 20;

    std::string folder_;
    std::size_t most_in_memory_;
    mutable std::mutex mutex_;
    std::unique_ptr<reading::TemporaryFile> file_;
    std::vector<std::byte> memory_;  ///< follows the bytes in the file
};

}  // namespace d2b
