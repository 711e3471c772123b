#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/feature_sink.hpp"

namespace d2b {

/// Well-known binary of MultiPolygons, in one buffer that is used again and again. Rings are closed here, and
/// stand in the order and direction in which they are given.
class MultiPolygonWkb {
  public:
    explicit MultiPolygonWkb(bool with_z) : with_z_(with_z) {}

    /// @return ISO WKB in the byte order of this machine; valid until the next call
    [[nodiscard]] std::span<const std::byte> encode(const Feature& feature);

  private:
    void head(std::uint32_t flat_type, std::size_t count);
    void ring(const WorldRing& positions, double z);
    template <typename T>
    void put(T value);

    bool with_z_;
    std::vector<std::byte> bytes_;
};

}  // namespace d2b
