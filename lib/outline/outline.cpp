#include "outline/outline.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "outline/arc_graph.hpp"
#include "outline/changed_outlines.hpp"
#include "outline/noding.hpp"
#include "outline/simplify.hpp"
#include "outline/walls/regular_outlines.hpp"

namespace d2b {
namespace {

CellShape cell_shape(const Georeference& georeference, double x_stretch) {
    const Position col = georeference.step(0, 1);
    const Position row = georeference.step(1, 0);
    const CellShape shape{{col.x * x_stretch, col.y}, {row.x * x_stretch, row.y}};
    const double scale = 1 / std::sqrt(std::abs(cross(shape.col, shape.row)));
    return {scale * shape.col, scale * shape.row};
}

WallOptions wall_options(const OutlineRules& rules, const Georeference& georeference, double x_stretch) {
    return {rules.walls, rules.wall_tolerance, cell_shape(georeference, x_stretch), rules.wall_inset};
}

}  // namespace

Drawing choose_drawing(const OutlineRules& rules, const Georeference& georeference) {
    if (rules.walls != Walls::off)
        return Drawing::regularized;
    if (rules.simplify > 0)
        return Drawing::simplified;
    return georeference.axis_parallel() && !rules.reprojected ? Drawing::traced : Drawing::noded;
}

OutlineReach outline_reach(const ContourList& contours, const OutlineRules& rules,
                           const Georeference& georeference, double x_stretch, const StopRequest& stop) {
    // Without walls, outlines affect each other only through shared corners.
    const WallOptions walls = choose_drawing(rules, georeference) == Drawing::regularized
                                  ? wall_options(rules, georeference, x_stretch)
                                  : WallOptions{Walls::off, 0, {{1, 0}, {0, 1}}};
    OutlineReach reach{conflict_reach(walls), {}};
    for (ClusterPlan& cluster : wall_clusters(contours, walls, stop))
        reach.groups.push_back(std::move(cluster.numbers));
    return reach;
}

struct Outliner::Impl {
    const ContourList& contours;
    std::optional<CornerIndex> corners;
    std::optional<ArcGraph> arcs;
    std::optional<RegularOutlines> walls;
    std::optional<ChangedOutlines> changed;
    std::unique_ptr<Spool> spool;  // moved into `changed` on first use
    CellShape shape;

    /// Even keys are outlines, odd keys are separate footprints.
    [[nodiscard]] const ChangedOutlines::Kept* changed_at(std::size_t contour) const {
        return changed ? changed->find(2 * contour) : nullptr;
    }
    [[nodiscard]] const ChangedOutlines::Kept* changed_footprint(std::size_t contour) const {
        return changed ? changed->find(2 * contour + 1) : nullptr;
    }
    void put(std::size_t place, const FinePolygon& outline, const OutlineQuality& quality) {
        if (!changed)
            changed.emplace(std::move(spool));
        changed->put(place, outline, quality);
    }
};

namespace {

OutlineQuality quality_of(const WallQuality& quality) {
    // Closest mode used by more than 5 % of the length.
    constexpr double little = 0.05;
    OutlineStatus status = OutlineStatus::regularized;
    if (quality.simplified_share + quality.traced_share > little)
        status = OutlineStatus::simplified;
    if (quality.traced_share > little)
        status = OutlineStatus::kept_traced;
    return {status, quality.simplified_share, quality.traced_share, quality.deviation, quality.area_change};
}

}  // namespace

Outliner::Outliner(const ContourList& contours, Drawing drawing, const OutlineRules& rules,
                   const Georeference& georeference, double x_stretch, Context& context)
    : impl_(std::make_unique<Impl>(
          Impl{contours, {}, {}, {}, {}, context.make_spool(), cell_shape(georeference, x_stretch)})) {
    if (drawing == Drawing::noded || drawing == Drawing::simplified)
        impl_->corners.emplace(fetch_all(contours));
    context.check_stop();
    if (drawing == Drawing::simplified) {
        impl_->arcs = build_arc_graph(fetch_all(contours), context.threads->stop());
        simplify(impl_->arcs->arcs, rules.simplify, georeference, context.threads->stop());
    }
    if (drawing == Drawing::regularized) {
        impl_->walls.emplace(contours, wall_options(rules, georeference, x_stretch), context.make_spool(),
                             *context.threads);
    }
}

Outliner::Outliner(Outliner&&) noexcept = default;
Outliner& Outliner::operator=(Outliner&&) noexcept = default;
Outliner::~Outliner() = default;

OutlineQuality Outliner::changed_quality(OutlineQuality known, const FinePolygon& before,
                                         const FinePolygon& after) const {
    if (impl_->walls)
        known.area_change = (1 + known.area_change) * ChangedOutlines::grown(before, after) - 1;
    known.deviation_cells += impl_->walls ? ChangedOutlines::apart_cells(before, after, impl_->shape) : 0;
    // A replaced outline is no longer traced, so it must be validated.
    if (known.status == OutlineStatus::traced)
        known.status = OutlineStatus::simplified;
    return known;
}

void Outliner::replace(std::size_t contour, const FinePolygon& outline) {
    impl_->put(2 * contour, outline, changed_quality(quality(contour), this->outline(contour), outline));
}

void Outliner::replace_footprint(std::size_t contour, const FinePolygon& outline) {
    impl_->put(2 * contour + 1, outline,
               changed_quality(footprint_quality(contour), footprint(contour), outline));
}

OutlineQuality Outliner::quality(std::size_t contour) const {
    if (const auto* changed = impl_->changed_at(contour))
        return changed->quality;
    if (impl_->walls)
        return quality_of(impl_->walls->quality(contour));
    return {impl_->arcs ? OutlineStatus::simplified : OutlineStatus::traced, impl_->arcs ? 1.0 : 0.0, 0, 0,
            0};
}

OutlineQuality Outliner::footprint_quality(std::size_t contour) const {
    if (const auto* changed = impl_->changed_footprint(contour))
        return changed->quality;
    return impl_->walls ? quality_of(impl_->walls->footprint_quality(contour)) : quality(contour);
}

bool Outliner::has_own_footprints() const {
    return impl_->walls.has_value();
}

FinePolygon Outliner::outline(std::size_t contour) const {
    if (const auto* changed = impl_->changed_at(contour))
        return impl_->changed->outline(*changed);
    if (impl_->walls)
        return impl_->walls->polygon(contour);
    return impl_->arcs ? fine(impl_->arcs->polygon(contour)) : traced(contour);
}

FinePolygon Outliner::footprint(std::size_t contour) const {
    if (const auto* changed = impl_->changed_footprint(contour))
        return impl_->changed->outline(*changed);
    return impl_->walls ? impl_->walls->footprint(contour) : outline(contour);
}

/// Traces that do not touch cannot touch after simplification.
std::vector<std::vector<std::uint32_t>> Outliner::groups(const StopRequest& stop) const {
    std::vector<std::vector<std::uint32_t>> groups;
    const auto add = [&](const std::vector<ClusterPlan>& clusters) {
        for (const ClusterPlan& cluster : clusters)
            groups.push_back(cluster.numbers);
    };
    if (impl_->walls)
        add(impl_->walls->clusters());
    else
        add(wall_clusters(impl_->contours, {Walls::off, 0, {{1, 0}, {0, 1}}}, stop));
    return groups;
}

FinePolygon Outliner::traced(std::size_t contour) const {
    if (impl_->walls)
        return impl_->walls->traced(contour);
    const LatticePolygon polygon = traced_polygon(impl_->contours.fetch(contour));
    return fine(impl_->corners ? impl_->corners->noded(polygon) : polygon);
}

}  // namespace d2b
