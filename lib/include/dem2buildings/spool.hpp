#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace d2b {

/// Bytes that are put aside and read back later, by any thread.
class Spool {
  public:
    Spool() = default;
    Spool(const Spool&) = delete;
    Spool& operator=(const Spool&) = delete;
    virtual ~Spool() = default;

    /// @return where they begin @throws OutputError there is no room
    virtual std::uint64_t append(std::span<const std::byte> bytes) = 0;
    /// Reads what was appended. @throws OutputError
    virtual void read(std::uint64_t begin, std::span<std::byte> bytes) const = 0;
};

/// A spool in memory.
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

/// Something in a spool.
struct SpoolEntry {
    std::uint64_t begin = 0;
    std::uint64_t size = 0;
};

}  // namespace d2b
