#include "levels/region_graph.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace d2b {

RegionGraph::RegionGraph(std::vector<Region> regions, double own_border)
    : own_border_(own_border),
      regions_(std::move(regions)),
      sets_(static_cast<std::uint32_t>(regions_.size())),
      borders_(regions_.size()),
      given_(regions_.size(), 0),
      cheapest_(regions_.size()),
      changed_(regions_.size(), 0),
      place_(regions_.size(), none) {}

void RegionGraph::add_border(std::uint32_t a, std::uint32_t b, std::uint32_t length) {
    const auto add = [&](std::uint32_t from, std::uint32_t to) {
        ++given_[from];
        // Borders are added cell by cell, so the last one mostly matches.
        if (Borders& borders = borders_[from]; !borders.empty() && borders.back().region == to)
            borders.back().length += length;
        else
            borders.push_back({to, length});
    };
    add(a, b);
    add(b, a);
}

void RegionGraph::gather(std::uint32_t root_of) {
    Borders& borders = borders_[root_of];
    Border* const all = borders.data();
    const std::size_t count = borders.size();
    std::uint32_t kept = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t length = all[k].length;
        const std::uint32_t other = root(all[k].region);
        if (other == root_of)
            continue;
        const std::uint32_t place = place_[other];
        if (place == none) {
            place_[other] = kept;
            all[kept++] = {other, length};
        } else {
            all[place].length += length;
        }
    }
    borders.resize(kept);
    given_[root_of] = kept;
}

bool RegionGraph::still_holds(std::uint32_t root_of) const {
    const std::uint32_t then = cheapest_[root_of].merges;
    if (then == none || changed_[root_of] > then)
        return false;
    const Borders& borders = borders_[root_of];
    return std::ranges::all_of(borders,
                               [&](const Border& border) { return changed_[border.region] <= then; });
}

RegionGraph::Neighbour RegionGraph::cheapest(std::uint32_t root_of) {
    if (still_holds(root_of))
        return cheapest_[root_of].neighbour;
    gather(root_of);
    Neighbour best{none, std::numeric_limits<double>::infinity()};
    const Region here = regions_[root_of];
    const double own = own_border_;
    for (const Border& border : borders_[root_of]) {
        place_[border.region] = none;
        const double cost = added_error(here, regions_[border.region]) / (border.length + own);
        const bool better = (cost < best.cost) | ((cost == best.cost) & (border.region < best.region));
        best.cost = better ? cost : best.cost;
        best.region = better ? border.region : best.region;
    }
    cheapest_[root_of] = {best, merges_};
    return best;
}

std::uint32_t RegionGraph::merge(std::uint32_t a, std::uint32_t b) {
    // Moves the shorter list, so that each border moves O(log n) times.
    if (given_[a] < given_[b])
        std::swap(a, b);
    sets_.join_into(a, b);
    regions_[a].add(regions_[b]);
    borders_[a].insert(borders_[a].end(), borders_[b].begin(), borders_[b].end());
    given_[a] += given_[b];
    borders_[b] = {};
    changed_[a] = changed_[b] = ++merges_;
    return a;
}

}  // namespace d2b
