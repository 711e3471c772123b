#include "outline/walls/outline_builder.hpp"

#include <algorithm>
#include <utility>

#include "outline/fine_geometry.hpp"
#include "outline/walls/middles.hpp"

namespace d2b {
namespace {

/// Twice the signed area in fine squares, exact.
Int128 twice_area(const FineRing& ring) {
    Int128 sum = 0;
    for (std::size_t i = 2; i < ring.size(); ++i)
        sum += turn(ring[0], ring[i - 1], ring[i]);
    return sum;
}

}  // namespace

OutlineBuilder::OutlineBuilder(const WallOptions& options)
    : shape_(options.shape), cuts_corners_(Middles::cuts_corners(options.shape, options.tolerance)) {}

void OutlineBuilder::begin_ring(std::int64_t traced_area) {
    if (rings_++ > 0)
        result_.polygon.interiors.emplace_back();
    traced_ += traced_area;
}

OutlineBuilder::Kind OutlineBuilder::kind(Form form) const {
    if (form == Form::walls)
        return walls;
    return form == Form::cut && !cuts_corners_ ? traced : simplified;
}

void OutlineBuilder::add(const DrawnChain& stretch, const ChainForm& form, bool reversed) {
    const std::vector<FinePoint>& points = stretch.vertices;
    FineRing& to = ring();
    const auto begin = static_cast<std::uint32_t>(to.size());
    const auto last = static_cast<std::uint32_t>(points.size() - 1);
    for (const CircularArc& span : stretch.arcs)
        result_.polygon.arcs.push_back(
            {rings_ - 1, begin + (reversed ? last - span.first - span.edges : span.first), span.edges});
    if (reversed)
        to.insert(to.end(), points.rbegin(), points.rend() - 1);
    else
        to.insert(to.end(), points.begin(), points.end() - 1);
    for (std::size_t i = 1; i < points.size(); ++i)
        lengths_[kind(form.at((stretch.steps[i - 1] + stretch.steps[i]) / 2))] +=
            length(shape_.from_cells(static_cast<double>(points[i].row - points[i - 1].row),
                                     static_cast<double>(points[i].col - points[i - 1].col)));
    result_.quality.deviation = std::max(result_.quality.deviation, stretch.deviation);
}

WallOutline OutlineBuilder::finish() {
    const double whole = lengths_[walls] + lengths_[simplified] + lengths_[traced];
    WallQuality& quality = result_.quality;
    quality.simplified_share = whole > 0 ? lengths_[simplified] / whole : 0;
    quality.traced_share = whole > 0 ? lengths_[traced] / whole : 0;
    Int128 twice = twice_area(result_.polygon.exterior);
    for (const FineRing& interior : result_.polygon.interiors)
        twice += twice_area(interior);
    constexpr double unit = 2.0 * FinePoint::steps * FinePoint::steps;
    quality.area_change = static_cast<double>(twice) / unit / static_cast<double>(traced_) - 1;
    return std::move(result_);
}

}  // namespace d2b
