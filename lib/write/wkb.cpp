#include "write/wkb.hpp"

#include <bit>
#include <cstring>

#include "core/error.hpp"

namespace d2b {

namespace {

constexpr std::uint32_t polygon_type = 3;
constexpr std::uint32_t multi_polygon_type = 6;
constexpr std::uint32_t z_types = 1000;

}  // namespace

template <typename T>
void MultiPolygonWkb::put(T value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
}

void MultiPolygonWkb::head(std::uint32_t flat_type, std::size_t count) {
    put(static_cast<std::uint8_t>(std::endian::native == std::endian::little ? 1 : 0));
    put(with_z_ ? flat_type + z_types : flat_type);
    put(static_cast<std::uint32_t>(count));
}

void MultiPolygonWkb::ring(const WorldRing& positions, double z) {
    if (positions.size() < 3)
        throw OutputError("A polygon has a ring of fewer than three positions and cannot be written.");
    const auto position = [this, z](const Position& p) {
        put(p.x);
        put(p.y);
        if (with_z_)
            put(z);
    };
    put(static_cast<std::uint32_t>(positions.size() + 1));
    for (const Position& p : positions)
        position(p);
    position(positions.front());
}

std::span<const std::byte> MultiPolygonWkb::encode(const Feature& feature) {
    if (feature.parts.empty())
        throw OutputError("A feature without a polygon cannot be written.");
    bytes_.clear();
    head(multi_polygon_type, feature.parts.size());
    for (const WorldPolygon& polygon : feature.parts) {
        head(polygon_type, 1 + polygon.interiors.size());
        ring(polygon.exterior, feature.z);
        for (const WorldRing& interior : polygon.interiors)
            ring(interior, feature.z);
    }
    return bytes_;
}

}  // namespace d2b
