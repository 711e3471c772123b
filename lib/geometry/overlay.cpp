#define GEOS_USE_ONLY_R_API
#include "geometry/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/box_tree.hpp"
#include "geometry/dissolve.hpp"
#include "geometry/geos_polygons.hpp"
#include "geometry/validity.hpp"

namespace d2b {
namespace {

bool finite(const Position& p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Returns true if GEOS can create a ring from it.
bool usable(const WorldRing& ring) {
    return ring.size() >= 3 && std::ranges::all_of(ring, finite);
}

/// Removes non-finite positions and rings that GEOS cannot create.
Polygons usable_parts(const Polygons& feature) {
    Polygons result;
    for (WorldPolygon polygon : feature) {
        std::erase_if(polygon.exterior, [](const Position& p) { return !finite(p); });
        for (WorldRing& ring : polygon.interiors)
            std::erase_if(ring, [](const Position& p) { return !finite(p); });
        std::erase_if(polygon.interiors, [](const WorldRing& ring) { return !usable(ring); });
        if (usable(polygon.exterior))
            result.push_back(std::move(polygon));
    }
    return result;
}

struct PreparedDeleter {
    GEOSContextHandle_t context = nullptr;
    void operator()(const GEOSPreparedGeometry* geometry) const {
        GEOSPreparedGeom_destroy_r(context, geometry);
    }
};

/// Prepared geometry, for testing many others against it.
class Prepared {
  public:
    Prepared(const GeosPolygons& geos, std::span<const WorldPolygon> polygons)
        : geos_(&geos),
          geometry_(geos.multi_polygon(polygons)),
          prepared_(GEOSPrepare_r(geos.context(), geometry_.get()), PreparedDeleter{geos.context()}) {}
    [[nodiscard]] bool meets(const GEOSGeometry* other) const {
        return geos_->answer(GEOSPreparedIntersects_r(geos_->context(), prepared_.get(), other));
    }

  private:
    const GeosPolygons* geos_;
    GeometryPtr geometry_;
    std::unique_ptr<const GEOSPreparedGeometry, PreparedDeleter> prepared_;
};

}  // namespace

struct Overlay::Impl {
    GeosPolygons geos;
};

Overlay::Overlay() : impl_(std::make_unique<Impl>()) {}
Overlay::Overlay(Overlay&&) noexcept = default;
Overlay& Overlay::operator=(Overlay&&) noexcept = default;
Overlay::~Overlay() = default;

bool Overlay::valid(const Polygons& feature) {
    return invalidity(impl_->geos, feature).empty();
}

Polygons Overlay::made_valid(const Polygons& feature) {
    return repaired(impl_->geos, usable_parts(feature));
}

Dissolved Overlay::dissolve(std::span<const Polygons> features) {
    Cover cover = cover_of(impl_->geos, features, CoverKind::once_and_twice);
    return {std::move(cover.once), std::move(cover.twice)};
}

Polygons Overlay::union_of(std::span<const Polygons> features) {
    return cover_of(impl_->geos, features, CoverKind::once).once;
}

Polygons Overlay::repaired_union(std::span<const WorldPolygon> polygons) {
    std::vector<Polygons> parts;
    for (const WorldPolygon& polygon : polygons) {
        const Polygons part{polygon};
        parts.push_back(valid(part) ? part : made_valid(part));
    }
    return union_of(parts);
}

Polygons Overlay::intersection(const Polygons& a, const Polygons& b) {
    const GeosPolygons& geos = impl_->geos;
    const GeometryPtr first = geos.multi_polygon(a);
    const GeometryPtr second = geos.multi_polygon(b);
    return geos.polygons_of<WorldPolygon>(
        geos.own(GEOSIntersection_r(geos.context(), first.get(), second.get())).get());
}

std::vector<Polyline> Overlay::rings_within(const Polygons& area, const Polygons& other) {
    const GeosPolygons& geos = impl_->geos;
    const GeometryPtr rings = geos.multi_line(area);
    const GeometryPtr within = geos.multi_polygon(other);
    return geos.lines_of(geos.own(GEOSIntersection_r(geos.context(), rings.get(), within.get())).get());
}

std::vector<bool> Overlay::touching(std::span<const Polygons> features, const Polygons& area) {
    const GeosPolygons& geos = impl_->geos;
    const Prepared prepared(geos, area);
    std::vector<bool> result;
    result.reserve(features.size());
    for (const Polygons& feature : features)
        result.push_back(prepared.meets(geos.multi_polygon(feature).get()));
    return result;
}

std::vector<std::optional<std::size_t>> Overlay::holders(std::span<const WorldPolygon> inners,
                                                         std::span<const WorldPolygon> outers) {
    const GeosPolygons& geos = impl_->geos;
    std::vector<Box> boxes;
    for (const WorldPolygon& outer : outers)
        boxes.push_back(box_of(std::span(&outer, 1)));
    const BoxTree tree(boxes);
    std::vector<std::optional<Prepared>> prepared(outers.size());
    std::vector<std::optional<std::size_t>> result;
    for (const WorldPolygon& inner : inners) {
        const GeometryPtr polygon = geos.polygon(inner);
        const GeometryPtr point = geos.own(GEOSPointOnSurface_r(geos.context(), polygon.get()));
        std::optional<std::size_t>& holder = result.emplace_back();
        Position p;
        if (GEOSGeomGetX_r(geos.context(), point.get(), &p.x) != 1 ||
            GEOSGeomGetY_r(geos.context(), point.get(), &p.y) != 1)
            continue;  // empty interior
        tree.query(Box{p.x, p.y, p.x, p.y}, [&](std::size_t i) {
            if (!prepared[i])
                prepared[i].emplace(geos, outers.subspan(i, 1));
            if (!holder && prepared[i]->meets(point.get()))
                holder = i;
        });
    }
    return result;
}

std::size_t Overlay::simplified_vertices(const Polygons& feature, double tolerance) {
    const GeosPolygons& geos = impl_->geos;
    const GeometryPtr geometry = geos.multi_polygon(feature);
    const GeometryPtr simple =
        geos.own(GEOSTopologyPreserveSimplify_r(geos.context(), geometry.get(), tolerance));
    return static_cast<std::size_t>(std::max(0, GEOSGetNumCoordinates_r(geos.context(), simple.get())));
}

}  // namespace d2b
