#include "contours/components.hpp"

#include <iterator>
#include <utility>

namespace d2b::contours {

std::uint32_t Components::allocate() {
    if (free_ == no_index) {
        pool_.emplace_back();
        return static_cast<std::uint32_t>(pool_.size() - 1);
    }
    return std::exchange(free_, pool_[free_].next_member);
}

std::uint32_t Components::add(Component&& found) {
    const std::uint32_t number = allocate();
    Component& c = pool_[number] = std::move(found);
    c.up = c.next_member = number;
    return number;
}

std::uint32_t Components::add(std::int32_t level, Label label, LatticePoint first, std::uint32_t below) {
    const std::uint32_t number = add(Component{});
    Component& c = pool_[number];
    c.level = level;
    c.label = label;
    c.first = first;
    c.last_row = first.row;
    c.below = below;
    if (level == 1)
        c.sample = std::make_unique<ElevationSample>();
    return number;
}

std::uint32_t Components::find(std::uint32_t component) {
    while (pool_[component].up != component) {
        pool_[component].up = pool_[pool_[component].up].up;
        component = pool_[component].up;
    }
    return component;
}

std::uint32_t Components::unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b)
        return a;
    if (pool_[a].size < pool_[b].size)
        std::swap(a, b);
    Component& into = pool_[a];
    Component& from = pool_[b];
    from.up = a;
    into.size += from.size;
    std::swap(into.next_member, from.next_member);
    into.last_row = std::max(into.last_row, from.last_row);
    into.first = std::min(into.first, from.first);
    into.open_above = into.open_above || from.open_above;
    into.own.merge(from.own);
    into.above.merge(from.above);
    // The exterior ring of a contour closes last, so all rings closed before are interiors.
    if (into.interiors.size() < from.interiors.size())
        std::swap(into.interiors, from.interiors);
    into.interiors.insert(into.interiors.end(), std::make_move_iterator(from.interiors.begin()),
                          std::make_move_iterator(from.interiors.end()));
    from.interiors = {};
    if (into.sample)
        into.sample->merge(*from.sample, range_);
    from.sample.reset();
    if (into.children.size() < from.children.size())
        std::swap(into.children, from.children);
    into.children.insert(into.children.end(), from.children.begin(), from.children.end());
    from.children = {};
    return a;
}

FinishedContour Components::finish(std::uint32_t root) {
    Component& c = pool_[root];
    FinishedContour finished;
    Contour& contour = finished.contour;
    contour.key = {c.level, c.first};
    contour.label = c.label;
    contour.exterior = std::move(c.exterior);
    contour.interiors = std::move(c.interiors);
    contour.own = c.own;
    contour.above = c.above;
    contour.lowest_outside = c.lowest_outside;
    if (c.sample)
        finished.sample = std::move(*c.sample);
    finished.children = std::move(c.children);
    c.sample.reset();
    // Members form a circular list through next_member; splice it into the free list.
    const std::uint32_t second = c.next_member;
    c.next_member = free_;
    free_ = second;
    return finished;
}

}  // namespace d2b::contours
