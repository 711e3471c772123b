#include "geometry/box_tree.hpp"

#include <numeric>
#include <utility>

namespace d2b {

namespace {

constexpr std::size_t leaf_size = 4;

}  // namespace

Box box_of(std::span<const Position> positions) {
    Box box;
    for (const Position& p : positions)
        box.add(p);
    return box;
}

Box box_of(std::span<const WorldPolygon> polygons) {
    Box box;
    for (const WorldPolygon& polygon : polygons)
        box.add(box_of(std::span<const Position>(polygon.exterior)));
    return box;
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!order_.empty())
        build(0, order_.size());
}

// NOLINTNEXTLINE(misc-no-recursion): as deep as halves can be halved
void BoxTree::build(std::size_t begin, std::size_t end) {
    const std::size_t at = nodes_.size();
    nodes_.push_back({{}, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), 0});
    Box box;
    Box centres;
    for (std::size_t i = begin; i < end; ++i) {
        box.add(boxes_[order_[i]]);
        centres.add(boxes_[order_[i]].centre());
    }
    nodes_[at].box = box;
    if (end - begin <= leaf_size)
        return;
    const bool wide = centres.right - centres.left > centres.high - centres.low;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto first = order_.begin();
    std::nth_element(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle),
                     first + static_cast<std::ptrdiff_t>(end), [&](std::uint32_t a, std::uint32_t b) {
                         const Position p = boxes_[a].centre();
                         const Position q = boxes_[b].centre();
                         return wide ? p.x < q.x : p.y < q.y;
                     });
    build(begin, middle);
    nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
    build(middle, end);
}

}  // namespace d2b
