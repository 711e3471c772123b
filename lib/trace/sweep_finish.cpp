// What ends on the line: rings that close, and contours whose last row has passed.
#include <algorithm>
#include <utility>

#include "trace/simple_rings.hpp"
#include "trace/sweep.hpp"

namespace d2b {

void Sweep::add_ring(std::uint32_t component, const std::vector<Corner>& outline) {
    Component& c = components_[component];
    for (const auto& corners : split_at_pinches(outline)) {
        LatticeRing ring;
        ring.reserve(corners.size());
        for (const Corner& corner : corners)
            ring.push_back(corner.at);
        PackedRing packed(ring);
        if (packed.area() < 0) {
            c.interiors.push_back(std::move(packed));
            continue;
        }
        c.exterior = std::move(packed);
        for (const Corner& corner : corners)
            c.lowest_outside = std::min(c.lowest_outside, corner.outside);
    }
}

void Sweep::finish_ended(StackSink& sink) {
    for (auto level = previous_.levels.rbegin(); level != previous_.levels.rend(); ++level)
        for (const Run& run : *level) {
            const std::uint32_t root = components_.find(run.component);
            Component& c = components_[root];
            // -1 marks those already handed out: several runs of the row above may have been theirs.
            if (c.last_row >= 0 && c.last_row < line_)
                finish(root, sink);
        }
    std::swap(previous_, current_);
    current_.clear();
}

void Sweep::finish(std::uint32_t root, StackSink& sink) {
    Component& c = components_[root];
    c.last_row = -1;
    const std::int32_t level = c.level;
    Stack stack;
    if (c.sample)
        stack.sample = std::move(*c.sample);
    stack.standing_on_it = std::move(c.standing_on_it);
    const std::uint32_t below = c.below;
    ContourNode node = components_.finish(root);
    std::sort(node.contour.interiors.begin(), node.contour.interiors.end(),
              [](const PackedRing& a, const PackedRing& b) { return a.start() < b.start(); });
    if (level > 1) {
        components_.hang(std::move(node), components_.find(below));
        return;
    }
    stack.contours = components_.flatten(std::move(node));
    const Taken taken = sink.take(std::move(stack));
    if (level == 0)
        return;
    Component& ground = components_[components_.find(below)];
    ground.own.merge(taken.fallen);
    if (taken.handle >= 0)
        ground.standing_on_it.push_back(taken.handle);
}

}  // namespace d2b
