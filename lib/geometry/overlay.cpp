#define GEOS_USE_ONLY_R_API
#include "geometry/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "geometry/box_tree.hpp"
#include "geometry/geos_converter.hpp"
#include "geometry/validity.hpp"

namespace d2b {

namespace {

/// Polygons that do not overlap, with their bounding boxes.
class BoxedPolygons {
  public:
    void add(WorldPolygon polygon) {
        boxes_.push_back(box_of(std::span(&polygon, 1)));
        polygons_.push_back(std::move(polygon));
    }
    void add(BoxedPolygons other) {
        std::ranges::move(other.polygons_, std::back_inserter(polygons_));
        std::ranges::move(other.boxes_, std::back_inserter(boxes_));
    }
    [[nodiscard]] bool empty() const { return polygons_.empty(); }
    [[nodiscard]] const std::vector<WorldPolygon>& polygons() const { return polygons_; }
    [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

    /// Removes and returns those whose boxes intersect none of the others.
    BoxedPolygons extract_disjoint(const BoxTree& others) {
        BoxedPolygons far;
        BoxedPolygons near;
        for (std::size_t i = 0; i < polygons_.size(); ++i) {
            const bool intersects = others.intersects_any(boxes_[i]);
            (intersects ? near : far).add(std::move(polygons_[i]));
        }
        *this = std::move(near);
        return far;
    }

  private:
    std::vector<WorldPolygon> polygons_;
    std::vector<Box> boxes_;
};

enum class CoverageKind { once, once_and_twice };

struct PieceCover {
    BoxedPolygons once;
    BoxedPolygons twice;
};

/// Cascaded union by recursive halving. Only pieces near the other half need an overlay operation. An area is
/// covered twice if it is so in one half or lies in both.
class CascadedUnion {
  public:
    CascadedUnion(const GeosConverter& geos, std::span<const std::vector<WorldPolygon>> features,
                  CoverageKind kind)
        : geos_(geos), features_(features), kind_(kind) {}

    /// @param items indices of features, in any order
    // NOLINTNEXTLINE(misc-no-recursion): as deep as halves can be halved
    [[nodiscard]] PieceCover cover(std::span<std::size_t> items) const {
        PieceCover result;
        if (items.size() <= 1) {
            for (const std::size_t item : items)
                for (const WorldPolygon& polygon : features_[item])
                    result.once.add(polygon);
            return result;
        }
        split(items);
        PieceCover a = cover(items.first(items.size() / 2));
        PieceCover b = cover(items.subspan(items.size() / 2));
        result.twice = join(std::move(a.twice), std::move(b.twice)).once;
        PieceCover both = join(std::move(a.once), std::move(b.once));
        result.once = std::move(both.once);
        result.twice = join(std::move(result.twice), std::move(both.twice)).once;
        return result;
    }

  private:
    /// Partitions features so that the half with lower center coordinates comes first.
    void split(std::span<std::size_t> items) const {
        const auto centre = [this](std::size_t item) { return box_of(features_[item]).centre(); };
        Box centres;
        for (const std::size_t item : items)
            centres.add(centre(item));
        const bool wide = centres.right - centres.left > centres.high - centres.low;
        std::ranges::nth_element(items, items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2), {},
                                 [&](std::size_t item) { return wide ? centre(item).x : centre(item).y; });
    }

    /// Computes union and intersection.
    [[nodiscard]] PieceCover join(BoxedPolygons a, BoxedPolygons b) const {
        PieceCover result;
        const BoxTree tree_of_a(a.boxes());
        const BoxTree tree_of_b(b.boxes());
        result.once = a.extract_disjoint(tree_of_b);
        result.once.add(b.extract_disjoint(tree_of_a));
        if (a.empty())
            return result;
        const GeometryPtr first = geos_.multi_polygon(a.polygons());
        const GeometryPtr second = geos_.multi_polygon(b.polygons());
        GEOSContextHandle_t context = geos_.context();
        add(GEOSUnion_r(context, first.get(), second.get()), result.once);
        if (kind_ == CoverageKind::once_and_twice)
            add(GEOSIntersection_r(context, first.get(), second.get()), result.twice);
        return result;
    }

    void add(GEOSGeometry* geometry, BoxedPolygons& pieces) const {
        for (WorldPolygon& polygon : geos_.polygons_of<WorldPolygon>(geos_.wrap(geometry).get()))
            pieces.add(std::move(polygon));
    }

    const GeosConverter& geos_;
    std::span<const std::vector<WorldPolygon>> features_;
    CoverageKind kind_;
};

/// @param kind `once` leaves the list `twice` empty
Dissolved coverage(const GeosConverter& geos, std::span<const Polygons> features, CoverageKind kind) {
    std::vector<std::size_t> items;
    for (std::size_t i = 0; i < features.size(); ++i)
        if (!features[i].empty())
            items.push_back(i);
    const PieceCover cover = CascadedUnion(geos, features, kind).cover(items);
    return {cover.once.polygons(), cover.twice.polygons()};
}

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

/// Prepared geometry, for testing many others against it.
class Prepared {
  public:
    Prepared(const GeosConverter& geos, std::span<const WorldPolygon> polygons)
        : geos_(&geos),
          geometry_(geos.multi_polygon(polygons)),
          prepared_(GEOSPrepare_r(geos.context(), geometry_.get()), {geos.context()}) {}
    [[nodiscard]] bool intersects(const GEOSGeometry* other) const {
        return geos_->predicate(GEOSPreparedIntersects_r(geos_->context(), prepared_.get(), other));
    }

  private:
    const GeosConverter* geos_;
    GeometryPtr geometry_;
    PreparedPtr prepared_;
};

}  // namespace

struct Overlay::Impl {
    GeosConverter geos;
};

Overlay::Overlay() : impl_(std::make_unique<Impl>()) {}
Overlay::Overlay(Overlay&&) noexcept = default;
Overlay& Overlay::operator=(Overlay&&) noexcept = default;
Overlay::~Overlay() = default;

bool Overlay::valid(const Polygons& feature) {
    return invalidity(impl_->geos, feature).empty();
}

Polygons Overlay::make_valid(const Polygons& feature) {
    return repaired(impl_->geos, usable_parts(feature));
}

Dissolved Overlay::dissolve(std::span<const Polygons> features) {
    return coverage(impl_->geos, features, CoverageKind::once_and_twice);
}

Polygons Overlay::union_of(std::span<const Polygons> features) {
    return coverage(impl_->geos, features, CoverageKind::once).once;
}

Polygons Overlay::repaired_union(std::span<const WorldPolygon> polygons) {
    std::vector<Polygons> parts;
    for (const WorldPolygon& polygon : polygons) {
        const Polygons part{polygon};
        parts.push_back(valid(part) ? part : make_valid(part));
    }
    return union_of(parts);
}

Polygons Overlay::intersection(const Polygons& a, const Polygons& b) {
    const GeosConverter& geos = impl_->geos;
    const GeometryPtr first = geos.multi_polygon(a);
    const GeometryPtr second = geos.multi_polygon(b);
    return geos.polygons_of<WorldPolygon>(
        geos.wrap(GEOSIntersection_r(geos.context(), first.get(), second.get())).get());
}

std::vector<Polyline> Overlay::clip_rings(const Polygons& area, const Polygons& other) {
    const GeosConverter& geos = impl_->geos;
    const GeometryPtr rings = geos.multi_line(area);
    const GeometryPtr within = geos.multi_polygon(other);
    return geos.lines_of(geos.wrap(GEOSIntersection_r(geos.context(), rings.get(), within.get())).get());
}

std::vector<bool> Overlay::intersecting(std::span<const Polygons> features, const Polygons& area) {
    const GeosConverter& geos = impl_->geos;
    const Prepared prepared(geos, area);
    std::vector<bool> result;
    result.reserve(features.size());
    for (const Polygons& feature : features)
        result.push_back(prepared.intersects(geos.multi_polygon(feature).get()));
    return result;
}

std::vector<std::optional<std::size_t>> Overlay::containing_polygons(std::span<const WorldPolygon> inners,
                                                                     std::span<const WorldPolygon> outers) {
    const GeosConverter& geos = impl_->geos;
    std::vector<Box> boxes;
    for (const WorldPolygon& outer : outers)
        boxes.push_back(box_of(std::span(&outer, 1)));
    const BoxTree tree(boxes);
    std::vector<std::optional<Prepared>> prepared(outers.size());
    std::vector<std::optional<std::size_t>> result;
    for (const WorldPolygon& inner : inners) {
        const GeometryPtr polygon = geos.polygon(inner);
        const GeometryPtr point = geos.wrap(GEOSPointOnSurface_r(geos.context(), polygon.get()));
        std::optional<std::size_t>& container = result.emplace_back();
        Position p;
        if (GEOSGeomGetX_r(geos.context(), point.get(), &p.x) != 1 ||
            GEOSGeomGetY_r(geos.context(), point.get(), &p.y) != 1)
            continue;  // empty interior
        tree.query(Box{p.x, p.y, p.x, p.y}, [&](std::size_t i) {
            if (!prepared[i])
                prepared[i].emplace(geos, outers.subspan(i, 1));
            if (!container && prepared[i]->intersects(point.get()))
                container = i;
        });
    }
    return result;
}

std::size_t Overlay::simplified_vertices(const Polygons& feature, double tolerance) {
    const GeosConverter& geos = impl_->geos;
    const GeometryPtr geometry = geos.multi_polygon(feature);
    const GeometryPtr simple =
        geos.wrap(GEOSTopologyPreserveSimplify_r(geos.context(), geometry.get(), tolerance));
    return static_cast<std::size_t>(std::max(0, GEOSGetNumCoordinates_r(geos.context(), simple.get())));
}

WorldRing Overlay::simplified_ring(const WorldRing& ring, double tolerance) {
    const GeosConverter& geos = impl_->geos;
    const GeometryPtr geometry = geos.line_ring(ring);
    const GeometryPtr simple =
        geos.wrap(GEOSTopologyPreserveSimplify_r(geos.context(), geometry.get(), tolerance));
    std::vector<Polyline> lines = geos.lines_of(simple.get());
    if (lines.empty())
        return {};
    lines.front().pop_back();
    return std::move(lines.front());
}

}  // namespace d2b
