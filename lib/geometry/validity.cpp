#define GEOS_USE_ONLY_R_API
#include "geometry/validity.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string_view>
#include <tuple>

#include "core/disjoint_sets.hpp"
#include "core/for_rings.hpp"
#include "dem2buildings/error.hpp"
#include "geometry/box_tree.hpp"

namespace d2b {
namespace {

struct Vertex {
    Position at;
    std::uint32_t ring = 0;

    [[nodiscard]] std::tuple<double, double, std::uint32_t> key() const { return {at.x, at.y, ring}; }
};

bool covers(const Box& outer, const Box& inner) {
    return outer.left <= inner.left && outer.right >= inner.right && outer.low <= inner.low &&
           outer.high >= inner.high;
}

struct FreeText {
    GEOSContextHandle_t context;
    void operator()(char* text) const { GEOSFree_r(context, text); }
};

/// Reason why GEOS cannot create a ring, or nullptr.
const char* wrong_points(const WorldRing& ring) {
    if (ring.empty())
        return "a ring has no points";
    for (const Position& p : ring)
        if (!std::isfinite(p.x) || !std::isfinite(p.y))
            return "a coordinate is not a finite number";
    return nullptr;
}

const char* wrong_points(const WorldPolygon& polygon) {
    if (const char* wrong = wrong_points(polygon.exterior))
        return wrong;
    for (const WorldRing& ring : polygon.interiors)
        if (const char* wrong = wrong_points(ring))
            return wrong;
    return nullptr;
}

/// Result of GEOS for finite polygons.
std::string plain_invalidity(const GeosConverter& geos, std::span<const WorldPolygon> polygons) {
    GeometryPtr geometry;
    try {
        geometry = polygons.size() == 1 ? geos.polygon(polygons.front()) : geos.multi_polygon(polygons);
    } catch (const GeometryError& error) {
        return error.what();
    }
    const char valid = GEOSisValid_r(geos.context(), geometry.get());
    geos.stop().check();
    if (valid == 1)
        return {};
    const std::unique_ptr<char, FreeText> reason(GEOSisValidReason_r(geos.context(), geometry.get()),
                                                 FreeText{geos.context()});
    geos.stop().check();
    return reason ? reason.get() : "invalid";
}

std::string invalidity_inside_out(const GeosConverter& geos, const WorldPolygon& polygon) {
    std::string reason = plain_invalidity(geos, inside_out(polygon));
    constexpr std::string_view nested = "Nested shells";
    if (reason.starts_with(nested))
        return "Hole lies outside shell or in another hole" + reason.substr(nested.size());
    if (!reason.empty())
        return reason;
    if (const std::optional<Position> parted = disconnected_at(polygon))
        return "Interior is disconnected[" + std::to_string(parted->x) + " " + std::to_string(parted->y) +
               "]";
    return {};
}

}  // namespace

bool needs_inside_out_check(const WorldPolygon& polygon) {
    constexpr double most_comparisons = 1e7;  // about 30 ms
    return static_cast<double>(polygon.exterior.size()) * static_cast<double>(polygon.interiors.size()) >
           most_comparisons;
}

std::vector<WorldPolygon> inside_out(const WorldPolygon& polygon) {
    Box frame = box_of(polygon.exterior);
    const double room = frame.right - frame.left + frame.high - frame.low;
    frame = {frame.left - room, frame.low - room, frame.right + room, frame.high + room};
    std::vector<WorldPolygon> result;
    result.reserve(polygon.interiors.size() + 1);
    result.push_back({{{frame.left, frame.low},
                       {frame.right, frame.low},
                       {frame.right, frame.high},
                       {frame.left, frame.high}},
                      {polygon.exterior}});
    for (const WorldRing& ring : polygon.interiors)
        result.push_back({ring, {}});
    return result;
}

/// Rings that touch each other in a cycle, at different points, disconnect the interior.
std::optional<Position> disconnected_at(const WorldPolygon& polygon) {
    std::vector<Vertex> vertices;
    std::uint32_t rings = 0;
    const auto add = [&](const WorldRing& ring) {
        for (const Position& p : ring)
            vertices.push_back({p, rings});
        ++rings;
    };
    for_rings(polygon, add);
    std::ranges::sort(vertices, {}, &Vertex::key);
    DisjointSets touching(rings);
    for (std::size_t i = 1; i < vertices.size(); ++i) {
        const Vertex& a = vertices[i - 1];
        const Vertex& b = vertices[i];
        if (a.at.x != b.at.x || a.at.y != b.at.y || a.ring == b.ring)
            continue;
        if (touching.find(a.ring) == touching.find(b.ring))
            return b.at;
        touching.join(a.ring, b.ring);
    }
    return {};
}

std::vector<WorldPolygon> without_empty_holes(std::span<const WorldPolygon> polygons) {
    std::vector<Box> boxes;
    boxes.reserve(polygons.size());
    for (const WorldPolygon& polygon : polygons)
        boxes.push_back(box_of(polygon.exterior));
    const BoxTree tree(boxes);
    std::vector<WorldPolygon> result;
    result.reserve(polygons.size());
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        WorldPolygon& kept = result.emplace_back(WorldPolygon{polygons[i].exterior, {}});
        for (const WorldRing& ring : polygons[i].interiors) {
            const Box hole = box_of(ring);
            bool holds = false;
            tree.query(hole, [&](std::size_t other) { holds |= other != i && covers(hole, boxes[other]); });
            if (holds)
                kept.interiors.push_back(ring);
        }
    }
    return result;
}

std::string invalidity(const GeosConverter& geos, std::span<const WorldPolygon> polygons) {
    for (const WorldPolygon& polygon : polygons)
        if (const char* wrong = wrong_points(polygon))
            return wrong;
    if (std::ranges::none_of(polygons, needs_inside_out_check))
        return plain_invalidity(geos, polygons);
    for (const WorldPolygon& polygon : polygons) {
        std::string reason = needs_inside_out_check(polygon) ? invalidity_inside_out(geos, polygon)
                                                             : plain_invalidity(geos, std::span(&polygon, 1));
        if (!reason.empty())
            return reason;
    }
    return polygons.size() == 1 ? std::string() : plain_invalidity(geos, without_empty_holes(polygons));
}

std::vector<WorldPolygon> repaired(const GeosConverter& geos, std::span<const WorldPolygon> polygons) {
    GEOSContextHandle_t context = geos.context();
    const GeometryPtr geometry = geos.multi_polygon(polygons);
    GEOSMakeValidParams* params = GEOSMakeValidParams_create_r(context);
    GEOSMakeValidParams_setMethod_r(context, params, GEOS_MAKE_VALID_STRUCTURE);
    GEOSGeometry* made = GEOSMakeValidWithParams_r(context, geometry.get(), params);
    GEOSMakeValidParams_destroy_r(context, params);
    return geos.polygons_of<WorldPolygon>(geos.wrap(made).get());
}

}  // namespace d2b
