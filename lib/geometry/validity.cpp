#define GEOS_USE_ONLY_R_API
#include "geometry/validity.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>

#include "dem2buildings/error.hpp"
#include "geometry/vast_polygons.hpp"

namespace d2b {
namespace {

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
std::string plain_invalidity(const GeosPolygons& geos, std::span<const WorldPolygon> polygons) {
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

std::string invalidity_of_vast(const GeosPolygons& geos, const WorldPolygon& polygon) {
    std::string reason = plain_invalidity(geos, inside_out(polygon));
    constexpr std::string_view nested = "Nested shells";
    if (reason.starts_with(nested))
        return "Hole lies outside shell or in another hole" + reason.substr(nested.size());
    if (!reason.empty())
        return reason;
    if (const std::optional<Position> parted = parted_at(polygon))
        return "Interior is disconnected[" + std::to_string(parted->x) + " " + std::to_string(parted->y) +
               "]";
    return {};
}

}  // namespace

std::string invalidity(const GeosPolygons& geos, std::span<const WorldPolygon> polygons) {
    for (const WorldPolygon& polygon : polygons)
        if (const char* wrong = wrong_points(polygon))
            return wrong;
    if (std::ranges::none_of(polygons, is_vast))
        return plain_invalidity(geos, polygons);
    for (const WorldPolygon& polygon : polygons) {
        std::string reason = is_vast(polygon) ? invalidity_of_vast(geos, polygon)
                                              : plain_invalidity(geos, std::span(&polygon, 1));
        if (!reason.empty())
            return reason;
    }
    return polygons.size() == 1 ? std::string() : plain_invalidity(geos, without_empty_holes(polygons));
}

std::vector<WorldPolygon> repaired(const GeosPolygons& geos, std::span<const WorldPolygon> polygons) {
    GEOSContextHandle_t context = geos.context();
    const GeometryPtr geometry = geos.multi_polygon(polygons);
    GEOSMakeValidParams* params = GEOSMakeValidParams_create_r(context);
    GEOSMakeValidParams_setMethod_r(context, params, GEOS_MAKE_VALID_STRUCTURE);
    GEOSGeometry* made = GEOSMakeValidWithParams_r(context, geometry.get(), params);
    GEOSMakeValidParams_destroy_r(context, params);
    return geos.polygons_of<WorldPolygon>(geos.own(made).get());
}

}  // namespace d2b
