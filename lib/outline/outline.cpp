#include "outline/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/for_rings.hpp"
#include "dem2buildings/spool.hpp"
#include "geometry/box_tree.hpp"
#include "outline/arc_graph.hpp"
#include "outline/fine_geometry.hpp"
#include "outline/packed_outline.hpp"
#include "outline/simplify.hpp"
#include "outline/walls/fit_walls.hpp"
#include "outline/walls/trace_sums.hpp"

namespace d2b::outline {

namespace {

double twice_area(const FinePolygon& polygon) {
    Int128 sum = 0;
    for_rings(polygon, [&](const FineRing& ring) { sum += outline::twice_area(ring); });
    return static_cast<double>(sum);
}

/// Edges of a polygon in an R-tree.
class EdgeIndex {
  public:
    EdgeIndex(const FinePolygon& polygon, const CellShape& shape) : shape_(shape), tree_(boxes(polygon)) {}

    /// Distance in cells from the nearest edge. Searches a growing box, because scanning all edges is rarely
    /// necessary.
    [[nodiscard]] double distance_to(FinePoint point) const;

  private:
    std::vector<Box> boxes(const FinePolygon& polygon) {
        std::vector<Box> boxes;
        for_rings(polygon, [&](const FineRing& ring) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                edges_.push_back({ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]});
                boxes.push_back(box_of(edges_.back()));
            }
        });
        return boxes;
    }

    const CellShape& shape_;
    std::vector<FineSegment> edges_;
    BoxTree tree_;
};

double EdgeIndex::distance_to(FinePoint point) const {
    const auto vec = [&](FinePoint p) { return shape_.from_fine(p, {}); };
    constexpr double widest = 1e9;
    double least = std::numeric_limits<double>::infinity();
    double cells = 2;
    while (cells < widest && least > cells) {
        const double steps = cells * FinePoint::steps * shape_.longer_side();
        const auto x = static_cast<double>(point.col);
        const auto y = static_cast<double>(point.row);
        tree_.query({x - steps, y - steps, x + steps, y + steps}, [&](std::size_t i) {
            const Vec2 p = vec(point);
            const Vec2 a = vec(edges_[i].from);
            const Vec2 b = vec(edges_[i].to);
            least = std::min(least, length(p - (a + nearest_parameter(p, a, b) * (b - a))));
        });
        cells *= 4;
    }
    return least;
}

/// Largest distance between the corners of one polygon that the other lacks and the other's edges.
double directed_distance(const FinePolygon& from, const FinePolygon& to, const CellShape& shape) {
    std::set<FinePoint> known;
    for_rings(to, [&](const FineRing& ring) { known.insert(ring.begin(), ring.end()); });
    const EdgeIndex edges(to, shape);
    double most = 0;
    for_rings(from, [&](const FineRing& ring) {
        for (const FinePoint& corner : ring)
            if (!known.contains(corner))
                most = std::max(most, edges.distance_to(corner));
    });
    return most;
}

CellShape cell_shape(const Georeference& georeference, double x_stretch) {
    const Position col = georeference.step(0, 1);
    const Position row = georeference.step(1, 0);
    const CellShape shape{{col.x * x_stretch, col.y}, {row.x * x_stretch, row.y}};
    const double scale = 1 / std::sqrt(std::abs(cross(shape.col, shape.row)));
    return {scale * shape.col, scale * shape.row};
}

WallOptions wall_options(const OutlineRules& rules, const Georeference& georeference, double x_stretch) {
    const CellShape shape = cell_shape(georeference, x_stretch);
    // In cells far from square, a distance spans many rows, all of which would be neighbours.
    constexpr double always = 1.5;
    constexpr double most_rows = 100;
    const double tolerance =
        std::min(rules.wall_tolerance, std::max(always, most_rows / shape.longer_side()));
    return {rules.walls,      wall_distance(tolerance), shape,      rules.wall_inset,
            rules.wall_price, rules.vertical_metres,    rules.frame};
}

/// Largest distance in cells between corners of one outline and edges of the other.
double max_distance_cells(const FinePolygon& one, const FinePolygon& other, const CellShape& shape) {
    return std::max(directed_distance(one, other, shape), directed_distance(other, one, shape));
}

std::vector<std::vector<std::uint32_t>> numbers_of(const std::vector<ClusterPlan>& clusters) {
    std::vector<std::vector<std::uint32_t>> numbers;
    numbers.reserve(clusters.size());
    for (const ClusterPlan& cluster : clusters)
        numbers.push_back(cluster.numbers);
    return numbers;
}

}  // namespace

double wall_distance(double tolerance) {
    constexpr double half_step = 0.5;
    return tolerance + std::min(half_step, tolerance / 2);
}

OutlineMethod choose_outline_method(const OutlineRules& rules, const Georeference& georeference) {
    if (rules.walls != Walls::off)
        return OutlineMethod::regularized;
    if (rules.simplify > 0)
        return OutlineMethod::simplified;
    return georeference.axis_parallel() && !rules.reprojected ? OutlineMethod::traced : OutlineMethod::noded;
}

OutlineDependencies outline_dependencies(const contours::ContourList& contours, const OutlineRules& rules,
                                         const Georeference& georeference, double x_stretch,
                                         const StopToken& stop) {
    // Without walls, outlines affect each other only through shared corners.
    const WallOptions walls = choose_outline_method(rules, georeference) == OutlineMethod::regularized
                                  ? wall_options(rules, georeference, x_stretch)
                                  : WallOptions{};
    return {conflict_distance(walls), numbers_of(wall_clusters(contours, walls, stop))};
}

struct Outliner::Impl {
    using Replaced = std::map<std::size_t, SpooledOutline>;  // by contour

    const contours::ContourList& contours;
    CellShape shape;
    std::optional<NodedRings> noded;
    std::optional<ArcGraph> arcs;
    std::optional<RegularizedOutlines> walls;
    std::unique_ptr<Spool> spool;  // of outlines that replace those derived from traces
    Replaced outlines;
    Replaced footprints;

    /// @return nullptr if it has not been replaced
    [[nodiscard]] static const SpooledOutline* find(const Replaced& replaced, std::size_t contour) {
        const auto found = replaced.find(contour);
        return found == replaced.end() ? nullptr : &found->second;
    }
};

Outliner::Outliner(const contours::ContourList& contours, OutlineMethod method, const OutlineRules& rules,
                   const Georeference& georeference, double x_stretch, Context& context)
    : impl_(std::make_unique<Impl>(
          Impl{contours, cell_shape(georeference, x_stretch), {}, {}, {}, context.make_spool(), {}, {}})) {
    const StopToken stop = context.threads->stop();
    if (method == OutlineMethod::noded || method == OutlineMethod::simplified)
        impl_->noded.emplace(contours::fetch_all(contours), stop);
    if (method == OutlineMethod::simplified) {
        impl_->arcs = build_arc_graph(*impl_->noded, stop);
        simplify(impl_->arcs->arcs, rules.simplify, georeference, stop);
    }
    if (method == OutlineMethod::regularized) {
        impl_->walls.emplace(contours, wall_options(rules, georeference, x_stretch), context.make_spool(),
                             *context.threads);
    }
}

Outliner::Outliner(Outliner&&) noexcept = default;
Outliner& Outliner::operator=(Outliner&&) noexcept = default;
Outliner::~Outliner() = default;

OutlineQuality Outliner::changed_quality(OutlineQuality known, const FinePolygon& before,
                                         const FinePolygon& after) const {
    if (impl_->walls) {
        known.area_change = (1 + known.area_change) * (twice_area(after) / twice_area(before)) - 1;
        known.deviation_cells += max_distance_cells(before, after, impl_->shape);
    }
    // A replaced outline is no longer traced, so it must be validated.
    if (known.status == OutlineStatus::traced)
        known.status = OutlineStatus::simplified;
    return known;
}

void Outliner::replace(std::size_t contour, const FinePolygon& outline) {
    const OutlineQuality changed = changed_quality(quality(contour), this->outline(contour), outline);
    impl_->outlines[contour] = spool_outline(outline, changed, *impl_->spool);
}

void Outliner::replace_footprint(std::size_t contour, const FinePolygon& outline) {
    const OutlineQuality changed = changed_quality(footprint_quality(contour), footprint(contour), outline);
    impl_->footprints[contour] = spool_outline(outline, changed, *impl_->spool);
}

OutlineQuality Outliner::quality(std::size_t contour) const {
    if (const auto* replaced = Impl::find(impl_->outlines, contour))
        return replaced->quality;
    if (impl_->walls)
        return impl_->walls->quality(contour);
    return {impl_->arcs ? OutlineStatus::simplified : OutlineStatus::traced, impl_->arcs ? 1.0 : 0.0, 0, 0,
            0};
}

OutlineQuality Outliner::footprint_quality(std::size_t contour) const {
    if (const auto* replaced = Impl::find(impl_->footprints, contour))
        return replaced->quality;
    return impl_->walls ? impl_->walls->footprint_quality(contour) : quality(contour);
}

bool Outliner::has_own_footprints() const {
    return impl_->walls.has_value();
}

FinePolygon Outliner::outline(std::size_t contour) const {
    if (const auto* replaced = Impl::find(impl_->outlines, contour))
        return load_outline(*impl_->spool, replaced->place);
    if (impl_->walls)
        return impl_->walls->polygon(contour);
    return impl_->arcs ? fine(impl_->arcs->polygon(contour)) : traced(contour);
}

FinePolygon Outliner::footprint(std::size_t contour) const {
    if (const auto* replaced = Impl::find(impl_->footprints, contour))
        return load_outline(*impl_->spool, replaced->place);
    return impl_->walls ? impl_->walls->footprint(contour) : outline(contour);
}

/// Traces that do not touch cannot touch after simplification.
std::vector<std::vector<std::uint32_t>> Outliner::groups(const StopToken& stop) const {
    return numbers_of(impl_->walls ? impl_->walls->clusters() : wall_clusters(impl_->contours, {}, stop));
}

FinePolygon Outliner::traced(std::size_t contour) const {
    if (impl_->walls)
        return impl_->walls->traced(contour);
    return fine(impl_->noded ? impl_->noded->polygon(contour)
                             : contours::traced_polygon(impl_->contours.fetch(contour)));
}

}  // namespace d2b::outline
