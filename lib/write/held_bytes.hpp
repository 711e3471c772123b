#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/spool.hpp"
#include "write/surface_file.hpp"

namespace d2b {

/// What comes later in a file than what is known later: in memory while it is little, then in a temporary
/// file.
class HeldBytes {
  public:
    /// @throws OutputError there is no room
    void add(std::string_view bytes);
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// Adds all of it to a file. @throws OutputError
    void write_to(SurfaceFile& file);

  private:
    void put_aside();

    FileSpool spool_;
    std::string waiting_;
    std::vector<SpoolEntry> entries_;
    std::uint64_t size_ = 0;
};

}  // namespace d2b
