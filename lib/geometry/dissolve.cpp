#define GEOS_USE_ONLY_R_API
#include "geometry/dissolve.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "geometry/box_tree.hpp"

namespace d2b {
namespace {

/// Polygons that do not overlap, with their bounding boxes.
class Pieces {
  public:
    void add(WorldPolygon polygon) {
        boxes_.push_back(box_of(std::span(&polygon, 1)));
        polygons_.push_back(std::move(polygon));
    }
    void add(Pieces other) {
        std::ranges::move(other.polygons_, std::back_inserter(polygons_));
        std::ranges::move(other.boxes_, std::back_inserter(boxes_));
    }
    [[nodiscard]] bool empty() const { return polygons_.empty(); }
    [[nodiscard]] const std::vector<WorldPolygon>& polygons() const { return polygons_; }
    [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

    /// Removes and returns those whose boxes intersect none of the others.
    Pieces take_far(const BoxTree& others) {
        Pieces far;
        Pieces near;
        for (std::size_t i = 0; i < polygons_.size(); ++i) {
            const bool meets = others.meets_any(boxes_[i]);
            (meets ? near : far).add(std::move(polygons_[i]));
        }
        *this = std::move(near);
        return far;
    }

  private:
    std::vector<WorldPolygon> polygons_;
    std::vector<Box> boxes_;
};

struct PieceCover {
    Pieces once;
    Pieces twice;
};

/// Cascaded union by recursive halving. Only pieces near the other half need an overlay operation.
class Dissolver {
  public:
    Dissolver(const GeosPolygons& geos, std::span<const std::vector<WorldPolygon>> features, CoverKind kind)
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
    [[nodiscard]] PieceCover join(Pieces a, Pieces b) const {
        PieceCover result;
        const BoxTree tree_of_a(a.boxes());
        const BoxTree tree_of_b(b.boxes());
        result.once = a.take_far(tree_of_b);
        result.once.add(b.take_far(tree_of_a));
        if (a.empty())
            return result;
        const GeometryPtr first = geos_.multi_polygon(a.polygons());
        const GeometryPtr second = geos_.multi_polygon(b.polygons());
        GEOSContextHandle_t context = geos_.context();
        add(GEOSUnion_r(context, first.get(), second.get()), result.once);
        if (kind_ == CoverKind::once_and_twice)
            add(GEOSIntersection_r(context, first.get(), second.get()), result.twice);
        return result;
    }

    void add(GEOSGeometry* geometry, Pieces& pieces) const {
        for (WorldPolygon& polygon : geos_.polygons_of<WorldPolygon>(geos_.own(geometry).get()))
            pieces.add(std::move(polygon));
    }

    const GeosPolygons& geos_;
    std::span<const std::vector<WorldPolygon>> features_;
    CoverKind kind_;
};

}  // namespace

Cover cover_of(const GeosPolygons& geos, std::span<const std::vector<WorldPolygon>> features,
               CoverKind kind) {
    std::vector<std::size_t> items;
    for (std::size_t i = 0; i < features.size(); ++i)
        if (!features[i].empty())
            items.push_back(i);
    const PieceCover cover = Dissolver(geos, features, kind).cover(items);
    return {cover.once.polygons(), cover.twice.polygons()};
}

}  // namespace d2b
