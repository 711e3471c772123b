#include "outline/outline.hpp"

#include <optional>

#include "outline/arc_graph.hpp"
#include "outline/simplify.hpp"

namespace d2b {

Drawing choose_drawing(const OutlineOptions& options, const Georeference& georeference) {
    if (options.simplify > 0)
        return Drawing::simplified;
    return georeference.axis_parallel() && options.target_crs.empty() ? Drawing::traced : Drawing::noded;
}

struct Outliner::Impl {
    const std::vector<Contour>& contours;
    std::optional<CornerIndex> corners;
    std::optional<ArcGraph> arcs;
};

Outliner::Outliner(const std::vector<Contour>& contours, Drawing drawing, const OutlineOptions& options,
                   const Georeference& georeference)
    : impl_(std::make_unique<Impl>(Impl{contours, {}, {}})) {
    if (drawing != Drawing::traced)
        impl_->corners.emplace(contours);
    if (drawing == Drawing::simplified) {
        impl_->arcs = build_arc_graph(contours);
        simplify(impl_->arcs->arcs, options.simplify, georeference);
    }
}

Outliner::Outliner(Outliner&&) noexcept = default;
Outliner& Outliner::operator=(Outliner&&) noexcept = default;
Outliner::~Outliner() = default;

OutlineStatus Outliner::status() const {
    return impl_->arcs ? OutlineStatus::simplified : OutlineStatus::traced;
}

LatticePolygon Outliner::outline(std::size_t contour) const {
    return impl_->arcs ? impl_->arcs->polygon(contour) : traced(contour);
}

LatticePolygon Outliner::traced(std::size_t contour) const {
    LatticePolygon polygon = traced_polygon(impl_->contours[contour]);
    return impl_->corners ? impl_->corners->noded(polygon) : polygon;
}

}  // namespace d2b
