#include "detect/region_overlaps.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>

namespace d2b {
namespace {

/// Finds the overlaps of two sets of runs in a row.
void add_row(std::span<const RegionRun> one, std::span<const RegionRun> other,
             std::vector<RegionOverlap>& found) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < one.size() && j < other.size()) {
        const std::int32_t common =
            std::min(one[i].end, other[j].end) - std::max(one[i].begin, other[j].begin);
        if (common > 0)
            found.push_back({one[i].label, other[j].label, common});
        if (one[i].end < other[j].end)
            ++i;
        else
            ++j;
    }
}

}  // namespace

std::vector<RegionOverlap> region_overlaps(const Regions& one, const Regions& other) {
    std::vector<RegionOverlap> found;
    for (std::int32_t r = 0; r < one.rows; ++r)
        add_row(one.row(r), other.row(r), found);
    std::ranges::sort(found, {}, [](const RegionOverlap& o) { return std::tuple(o.one, o.other); });
    std::size_t kept = 0;
    for (const RegionOverlap& overlap : found)
        if (kept > 0 && found[kept - 1].one == overlap.one && found[kept - 1].other == overlap.other)
            found[kept - 1].cells += overlap.cells;
        else
            found[kept++] = overlap;
    found.resize(kept);
    return found;
}

std::vector<Label> holders(const Regions& one, const Regions& other) {
    std::vector<Label> holder(one.cells.size(), 0);
    std::vector<std::int64_t> most(one.cells.size(), 0);
    for (const RegionOverlap& overlap : region_overlaps(one, other))
        if (overlap.cells > most[overlap.one]) {
            most[overlap.one] = overlap.cells;
            holder[overlap.one] = overlap.other;
        }
    return holder;
}

}  // namespace d2b
