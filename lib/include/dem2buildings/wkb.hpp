#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Encodes features as well-known binary of MultiPolygons, in one buffer that is reused because allocation
/// per feature is slow. Closes rings and keeps their order and direction. With arcs it writes MultiSurfaces:
/// polygons with arcs are CurvePolygons, whose rings with arcs are CompoundCurves of CircularStrings and
/// LineStrings. A feature with a place is a Point, without Z.
class MultiPolygonWkb {
  public:
    explicit MultiPolygonWkb(bool with_z, bool with_arcs = false) : with_z_(with_z), with_arcs_(with_arcs) {}

    /// @return ISO WKB in native byte order; valid until the next call
    [[nodiscard]] std::span<const std::byte> encode(const Feature& feature);
    /// Releases memory of an unusually large polygon. Invalidates the result of encode().
    void forget_large();
    /// Returns the capacity kept for the next polygon, in bytes.
    [[nodiscard]] std::size_t room() const { return bytes_.capacity(); }

  private:
    void head(std::uint32_t flat_type, std::size_t count);
    void point(const Position& place);
    void ring(const WorldRing& positions, double z, const double* elevations);
    void points(const WorldRing& positions, std::size_t first, std::size_t step, std::size_t count, double z,
                const double* elevations = nullptr);
    void curve_ring(const WorldRing& positions, std::vector<CircularArc> arcs, double z);
    void curve_polygon(const WorldPolygon& polygon, double z);
    template <typename T>
    void put(T value);

    bool with_z_;
    bool with_arcs_;
    std::vector<std::byte> bytes_;
};

}  // namespace d2b
