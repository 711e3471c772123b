#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/spool.hpp"
#include "write/surface_file.hpp"

namespace d2b {

/// Buffers bytes that come late in a file but are known early: in memory while they are few, then in a
/// temporary file.
class HeldBytes {
  public:
    /// @throws OutputError if there is no space
    void add(std::string_view bytes);
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// Appends all bytes to a file. @throws OutputError
    void write_to(SurfaceFile& file);

  private:
    void put_aside();

    FileSpool spool_;
    std::string waiting_;
    std::vector<SpoolEntry> entries_;
    std::uint64_t size_ = 0;
};

}  // namespace d2b
