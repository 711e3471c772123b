#include "dem2buildings/wkb.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "dem2buildings/error.hpp"

namespace d2b {

namespace {

constexpr std::uint32_t point_type = 1;
constexpr std::uint32_t line_string_type = 2;
constexpr std::uint32_t polygon_type = 3;
constexpr std::uint32_t multi_polygon_type = 6;
constexpr std::uint32_t circular_string_type = 8;
constexpr std::uint32_t compound_curve_type = 9;
constexpr std::uint32_t curve_polygon_type = 10;
constexpr std::uint32_t multi_surface_type = 12;
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

void MultiPolygonWkb::point(const Position& place) {
    put(static_cast<std::uint8_t>(std::endian::native == std::endian::little ? 1 : 0));
    put(point_type);
    put(place.x);
    put(place.y);
}

/// Writes every step-th position of a ring, wrapping around.
void MultiPolygonWkb::points(const WorldRing& positions, std::size_t first, std::size_t step,
                             std::size_t count, double z, const double* elevations) {
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = (first + i * step) % positions.size();
        put(positions[at].x);
        put(positions[at].y);
        if (with_z_)
            put(elevations != nullptr ? elevations[at] : z);
    }
}

/// @param elevations of its positions; null if all have z
void MultiPolygonWkb::ring(const WorldRing& positions, double z, const double* elevations) {
    if (positions.size() < 3)
        throw OutputError("A polygon has a ring of fewer than three positions and cannot be written.");
    put(static_cast<std::uint32_t>(positions.size() + 1));
    points(positions, 0, 1, positions.size() + 1, z, elevations);
}

/// @param arcs of this ring, not overlapping, with an even number of edges each
void MultiPolygonWkb::curve_ring(const WorldRing& positions, std::vector<CircularArc> arcs, double z) {
    if (arcs.empty()) {
        head(line_string_type, positions.size() + 1);
        points(positions, 0, 1, positions.size() + 1, z);
        return;
    }
    std::ranges::sort(arcs, {}, &CircularArc::first);
    // Edges between the end of an arc and the begin of the next one.
    const auto gap = [&](std::size_t i) {
        const CircularArc& next = arcs[(i + 1) % arcs.size()];
        const std::size_t round = i + 1 < arcs.size() ? 0 : positions.size();
        return next.first + round - (arcs[i].first + arcs[i].edges);
    };
    std::size_t pieces = arcs.size();
    for (std::size_t i = 0; i < arcs.size(); ++i)
        pieces += gap(i) > 0 ? 1U : 0U;
    head(compound_curve_type, pieces);
    for (std::size_t i = 0; i < arcs.size(); ++i) {
        head(circular_string_type, 3);
        points(positions, arcs[i].first, arcs[i].edges / 2, 3, z);
        if (gap(i) == 0)
            continue;
        head(line_string_type, gap(i) + 1);
        points(positions, arcs[i].first + arcs[i].edges, 1, gap(i) + 1, z);
    }
}

void MultiPolygonWkb::curve_polygon(const WorldPolygon& polygon, double z) {
    head(curve_polygon_type, 1 + polygon.interiors.size());
    for (std::size_t r = 0; r <= polygon.interiors.size(); ++r) {
        const WorldRing& positions = r == 0 ? polygon.exterior : polygon.interiors[r - 1];
        std::vector<CircularArc> arcs = polygon.arcs;
        std::erase_if(arcs, [&](const CircularArc& arc) { return arc.ring != r; });
        curve_ring(positions, std::move(arcs), z);
    }
}

std::span<const std::byte> MultiPolygonWkb::encode(const Feature& feature) {
    bytes_.clear();
    if (feature.place) {
        point(*feature.place);
        return bytes_;
    }
    if (feature.parts.empty())
        throw OutputError("A feature without a polygon cannot be written.");
    head(with_arcs_ ? multi_surface_type : multi_polygon_type, feature.parts.size());
    for (const WorldPolygon& polygon : feature.parts) {
        if (with_arcs_ && !polygon.arcs.empty()) {
            curve_polygon(polygon, feature.z);
            continue;
        }
        head(polygon_type, 1 + polygon.interiors.size());
        const double* elevations = polygon.elevations.empty() ? nullptr : polygon.elevations.data();
        const auto put_ring = [&](const WorldRing& positions) {
            ring(positions, feature.z, elevations);
            if (elevations != nullptr)
                elevations += positions.size();
        };
        put_ring(polygon.exterior);
        for (const WorldRing& interior : polygon.interiors)
            put_ring(interior);
    }
    return bytes_;
}

void MultiPolygonWkb::forget_large() {
    constexpr std::size_t large = std::size_t{1} << 20;
    if (bytes_.capacity() > large)
        bytes_ = std::vector<std::byte>();  // {} would keep the capacity
}

}  // namespace d2b
