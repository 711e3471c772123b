#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Well-known binary of MultiPolygons, in one buffer that is used again and again. Rings are closed here, and
/// stand in the order and direction in which they are given. With arcs, of MultiSurfaces: polygons that have
/// arcs are CurvePolygons, whose rings with arcs are CompoundCurves of CircularStrings and LineStrings. A
/// feature that is a place is a Point, without Z.
class MultiPolygonWkb {
  public:
    explicit MultiPolygonWkb(bool with_z, bool with_arcs = false) : with_z_(with_z), with_arcs_(with_arcs) {}

    /// @return ISO WKB in the byte order of this machine; valid until the next call
    [[nodiscard]] std::span<const std::byte> encode(const Feature& feature);
    /// Gives back the room of a polygon that was larger than most. What encode() gave is no longer valid.
    void forget_large();
    /// Bytes that are kept for the next polygon.
    [[nodiscard]] std::size_t room() const { return bytes_.capacity(); }

  private:
    void head(std::uint32_t flat_type, std::size_t count);
    void point(const Position& place);
    void ring(const WorldRing& positions, double z);
    void points(const WorldRing& positions, std::size_t first, std::size_t step, std::size_t count, double z);
    void curve_ring(const WorldRing& positions, std::vector<CircularArc> arcs, double z);
    void curve_polygon(const WorldPolygon& polygon, double z);
    template <typename T>
    void put(T value);

    bool with_z_;
    bool with_arcs_;
    std::vector<std::byte> bytes_;
};

}  // namespace d2b
