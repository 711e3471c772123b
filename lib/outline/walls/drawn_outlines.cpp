#include "outline/walls/drawn_outlines.hpp"

#include <algorithm>

namespace d2b {

WallOutline DrawnOutlines::outline(std::size_t contour) const {
    OutlineBuilder builder(options_);
    DrawnChain drawn;
    for (const RingAreas::Ring& ring : areas_.rings(contour)) {
        builder.begin_ring(ring.traced);
        for (const ArcUse& use : *ring.uses) {
            drawing_.arc(use.arc, drawn);
            builder.add(drawn, drawing_.form(graph_.chain_of[use.arc]), use.reversed);
        }
    }
    return builder.finish();
}

/// Returns true if low levels need a vertex between two uses of a ring, because the chain changes or other
/// low arcs end there.
bool DrawnOutlines::low_levels_meet(const ArcUse& before, const ArcUse& after) const {
    if (graph_.chain_of[before.arc] != graph_.chain_of[after.arc])
        return true;
    const std::uint32_t node = graph_.ends[after.arc][after.reversed ? 1 : 0];
    const auto is_low = [&](std::uint32_t end) {
        return graph_.ranks[end / 2] <= WallGraph::highest_low_rank;
    };
    return std::ranges::count_if(graph_.ends_at(node), is_low) != 2;
}

void DrawnOutlines::add_low(const std::vector<ArcUse>& uses, OutlineBuilder& builder) const {
    const std::size_t n = uses.size();
    std::size_t begin = 0;
    while (begin < n && !low_levels_meet(uses[(begin + n - 1) % n], uses[begin]))
        ++begin;
    DrawnChain drawn;
    for (std::size_t i = begin % n, left = n; left > 0;) {
        std::size_t count = 1;
        while (count < left && !low_levels_meet(uses[(i + count - 1) % n], uses[(i + count) % n]))
            ++count;
        const bool against = drawing_.stretch(uses[i], uses[(i + count - 1) % n], begin == n, drawn);
        builder.add(drawn, drawing_.form(graph_.chain_of[uses[i].arc]), against);
        i = (i + count) % n;
        left -= count;
    }
}

WallOutline DrawnOutlines::footprint(std::size_t contour) const {
    OutlineBuilder builder(options_);
    for (const RingAreas::Ring& ring : areas_.rings(contour)) {
        builder.begin_ring(ring.traced);
        add_low(*ring.uses, builder);
    }
    return builder.finish();
}

}  // namespace d2b
