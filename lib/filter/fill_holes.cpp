#include <algorithm>
#include <numeric>
#include <utility>

#include "filter/noise.hpp"

namespace d2b {
namespace {

using RingOf = std::function<LatticeRing(std::size_t)>;

/// Whether any of the keys, sorted, is of the level and lies in the hole: the rows of its box are searched.
bool any_inside(std::span<const ContourKey> keys, std::int32_t level, const Hole& hole, std::size_t number,
                const RingOf& ring_of) {
    LatticeRing ring;
    for (std::int32_t row = hole.low.row; row < hole.high.row; ++row) {
        auto key = std::ranges::lower_bound(keys, ContourKey{level, {row, hole.low.col}});
        for (; key != keys.end() && *key < ContourKey{level, {row, hole.high.col}}; ++key) {
            if (ring.empty())
                ring = ring_of(number);
            if (contains(ring, key->first))
                return true;
        }
    }
    return false;
}

}  // namespace

std::vector<bool> fill_holes(std::span<const ContourKey> keys, std::span<const Hole> holes,
                             const RingOf& ring_of, Context& context) {
    std::vector<std::uint32_t> order(holes.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return holes[i].level; });
    std::vector<bool> filled(holes.size());
    // An interior ring starts at the first square inside it: of the level below, those that remain.
    std::vector<ContourKey> remaining_below;
    std::vector<ContourKey> remaining;
    std::int32_t level = 0;
    for (const std::uint32_t i : order) {
        const Hole& hole = holes[i];
        for (; level < hole.level; ++level) {
            std::ranges::sort(remaining);
            remaining_below = std::exchange(remaining, {});
        }
        filled[i] = hole.reason && !any_inside(keys, level, hole, i, ring_of) &&
                    !any_inside(remaining_below, level - 1, hole, i, ring_of);
        if (filled[i])
            context.report.count(*hole.reason);
        else
            remaining.push_back({level, hole.start});
    }
    return filled;
}

}  // namespace d2b
