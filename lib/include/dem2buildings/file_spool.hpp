#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "dem2buildings/spool.hpp"

namespace d2b {

class TemporaryFile;

/// A spool in memory as long as it is small, and then in a temporary file without a name, which is gone with
/// the process however that ends.
class FileSpool : public Spool {
  public:
    /// @param folder for the file; "": that of the configuration option CPL_TMPDIR, or the system's
    /// @param in_memory bytes that need no file
    explicit FileSpool(std::string folder = "", std::size_t in_memory = std::size_t{32} << 20);
    ~FileSpool() override;

    /// @throws OutputError the file cannot be made, or there is no room for it
    std::uint64_t append(std::span<const std::byte> bytes) override;
    /// @throws OutputError
    void read(std::uint64_t begin, std::span<std::byte> bytes) const override;

  private:
    [[nodiscard]] std::uint64_t in_file() const;
    void flush();

    static constexpr std::size_t bytes_a_write = std::size_t{4} << 20;

    std::string folder_;
    std::size_t most_in_memory_;
    mutable std::mutex mutex_;
    std::unique_ptr<TemporaryFile> file_;
    std::vector<std::byte> memory_;  ///< comes after what is in the file
};

}  // namespace d2b
