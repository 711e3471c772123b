#include "geometry/box_tree.hpp"

#include <utility>

#define BOOST_ALLOW_DEPRECATED_HEADERS  // required by Boost 1.74's own headers
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>  // required by the R-tree of Boost 1.83
#include <boost/iterator/function_output_iterator.hpp>

namespace d2b {

Box box_of(std::span<const Position> positions) {
    Box box;
    for (const Position& p : positions)
        box.add(p);
    return box;
}

Box box_of(const FineSegment& segment) {
    Box box;
    for (const FinePoint& p : {segment.from, segment.to})
        box.add(Position{static_cast<double>(p.col), static_cast<double>(p.row)});
    return box;
}

Box box_of(std::span<const WorldPolygon> polygons) {
    Box box;
    for (const WorldPolygon& polygon : polygons)
        box.add(box_of(std::span<const Position>(polygon.exterior)));
    return box;
}

}  // namespace d2b

#undef BOOST_ALLOW_DEPRECATED_HEADERS

namespace d2b {
namespace {

namespace spatial_index = boost::geometry::index;
using Corner = boost::geometry::model::d2::point_xy<double>;
using Extent = boost::geometry::model::box<Corner>;
using Entry = std::pair<Extent, std::size_t>;
using Tree = spatial_index::rtree<Entry, spatial_index::rstar<16>>;

Extent extent_of(const Box& box) {
    return {{box.left, box.low}, {box.right, box.high}};
}

Tree packed(const std::vector<Box>& boxes) {
    std::vector<Entry> entries;
    entries.reserve(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        entries.emplace_back(extent_of(boxes[i]), i);
    return Tree(entries);
}

}  // namespace

struct BoxTree::Impl {
    Tree tree;
};

BoxTree::BoxTree(const std::vector<Box>& boxes) : impl_(std::make_unique<Impl>(Impl{packed(boxes)})) {}
BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;
BoxTree::~BoxTree() = default;

void BoxTree::query(const Box& box, const std::function<void(std::size_t)>& visit) const {
    impl_->tree.query(spatial_index::intersects(extent_of(box)),
                      boost::make_function_output_iterator([&](const Entry& entry) { visit(entry.second); }));
}

bool BoxTree::intersects_any(const Box& box) const {
    return impl_->tree.qbegin(spatial_index::intersects(extent_of(box))) != impl_->tree.qend();
}

}  // namespace d2b
