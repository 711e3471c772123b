#pragma once

#include <cstdint>
#include <vector>

#include "core/lattice.hpp"

namespace d2b {

/// A drawn polygon in some four bytes a vertex: from each vertex the way to the next one.
class PackedOutline {
  public:
    PackedOutline() = default;
    explicit PackedOutline(const FinePolygon& polygon);

    [[nodiscard]] FinePolygon polygon() const;

  private:
    std::vector<std::uint8_t> bytes_;
};

}  // namespace d2b
