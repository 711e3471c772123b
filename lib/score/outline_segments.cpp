#include "score/outline_segments.hpp"

#include <algorithm>
#include <cmath>

#define BOOST_ALLOW_DEPRECATED_HEADERS             // required by Boost 1.74's own headers
#include <boost/geometry/algorithms/distance.hpp>  // required by the R-tree of Boost 1.83
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/register/point.hpp>
#include <boost/geometry/geometries/register/segment.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#undef BOOST_ALLOW_DEPRECATED_HEADERS

BOOST_GEOMETRY_REGISTER_POINT_2D(d2b::Position, double, cs::cartesian, x, y)
BOOST_GEOMETRY_REGISTER_SEGMENT(d2b::OutlineSegment, d2b::Position, a, b)

namespace d2b {
namespace {

namespace index = boost::geometry::index;
using Tree = index::rtree<OutlineSegment, index::rstar<16>>;

Tree packed(std::span<const Polyline> lines) {
    std::vector<OutlineSegment> segments;
    for (const Polyline& line : lines)
        for (std::size_t i = 1; i < line.size(); ++i)
            segments.push_back({line[i - 1], line[i]});
    return Tree(segments);
}

boost::geometry::model::box<Position> around(Position p, double limit) {
    return {{p.x - limit, p.y - limit}, {p.x + limit, p.y + limit}};
}

}  // namespace

struct OutlineSegments::Impl {
    Tree tree;
};

double squared_distance(Position p, const OutlineSegment& segment) {
    const double dx = segment.b.x - segment.a.x;
    const double dy = segment.b.y - segment.a.y;
    const double px = p.x - segment.a.x;
    const double py = p.y - segment.a.y;
    const double length = dx * dx + dy * dy;
    const double t = length > 0 ? std::clamp((px * dx + py * dy) / length, 0.0, 1.0) : 0.0;
    const double x = px - t * dx;
    const double y = py - t * dy;
    return x * x + y * y;
}

OutlineSegments::OutlineSegments(std::span<const Polyline> lines)
    : impl_(std::make_unique<Impl>(Impl{packed(lines)})) {}
OutlineSegments::~OutlineSegments() = default;

double OutlineSegments::distance(Position p, double limit) const {
    double nearest = limit * limit;
    const auto measure = boost::make_function_output_iterator(
        [&](const OutlineSegment& segment) { nearest = std::min(nearest, squared_distance(p, segment)); });
    impl_->tree.query(index::nearest(p, 1), measure);
    return std::sqrt(nearest);
}

void OutlineSegments::within(Position p, double limit, std::vector<OutlineSegment>& found) const {
    found.clear();
    const auto keep = boost::make_function_output_iterator([&](const OutlineSegment& segment) {
        if (squared_distance(p, segment) < limit * limit)
            found.push_back(segment);
    });
    impl_->tree.query(index::intersects(around(p, limit)), keep);
}

}  // namespace d2b
