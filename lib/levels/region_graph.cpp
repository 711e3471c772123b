#include "levels/region_graph.hpp"

#include <utility>

namespace d2b {

RegionGraph::RegionGraph(std::vector<Region> regions)
    : regions_(std::move(regions)),
      sets_(static_cast<std::uint32_t>(regions_.size())),
      borders_(regions_.size()),
      place_(regions_.size(), none) {}

void RegionGraph::add_border(std::uint32_t a, std::uint32_t b, double length) {
    borders_[a].push_back({b, length});
    borders_[b].push_back({a, length});
}

double RegionGraph::added_error(const Region& one, const Region& other) {
    if (one.points == 0 || other.points == 0)
        return 0;
    const double step = one.sum / one.points - other.sum / other.points;
    return one.points * other.points / (one.points + other.points) * step * step;
}

void RegionGraph::gather(std::uint32_t root_of) {
    std::vector<Border>& borders = borders_[root_of];
    std::size_t kept = 0;
    for (const Border& border : borders) {
        const std::uint32_t other = root(border.region);
        if (other == root_of)
            continue;
        if (place_[other] == none) {
            place_[other] = static_cast<std::uint32_t>(kept);
            borders[kept++] = {other, border.length};
        } else {
            borders[place_[other]].length += border.length;
        }
    }
    borders.resize(kept);
    for (const Border& border : borders)
        place_[border.region] = none;
}

RegionGraph::Neighbour RegionGraph::cheapest(std::uint32_t root_of) {
    gather(root_of);
    Neighbour best;
    for (const Border& border : borders_[root_of]) {
        const double cost = added_error(regions_[root_of], regions_[border.region]) / border.length;
        if (best.region == none || cost < best.cost || (cost == best.cost && border.region < best.region))
            best = {border.region, cost};
    }
    return best;
}

std::uint32_t RegionGraph::merge(std::uint32_t a, std::uint32_t b) {
    // The shorter list moves, so that no border moves more often than a logarithm says.
    if (borders_[a].size() < borders_[b].size())
        std::swap(a, b);
    sets_.join_into(a, b);
    regions_[a].points += regions_[b].points;
    regions_[a].sum += regions_[b].sum;
    borders_[a].insert(borders_[a].end(), borders_[b].begin(), borders_[b].end());
    borders_[b] = {};
    return a;
}

}  // namespace d2b
