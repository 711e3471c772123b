#include "levels/region_graph.hpp"

#include <algorithm>
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
      place_(regions_.size(), none) {
    means_.reserve(regions_.size());
    for (const Region& region : regions_)
        means_.push_back(region.sum / region.points);
}

void RegionGraph::add_border(std::uint32_t a, std::uint32_t b, std::uint32_t length) {
    const auto add = [&](std::uint32_t from, std::uint32_t to) {
        ++given_[from];
        // A border comes cell by cell, so the last is mostly the same.
        if (Borders& borders = borders_[from]; !borders.empty() && borders.back().region == to)
            borders.back().length += length;
        else
            borders.push_back({to, length});
    };
    add(a, b);
    add(b, a);
}

namespace {

/// Squared error that merging two regions adds.
double error_of_union(double points, double mean, double other_points, double other_mean) {
    if (points == 0 || other_points == 0)
        return 0;
    const double step = mean - other_mean;
    return points * other_points / (points + other_points) * step * step;
}

}  // namespace

double RegionGraph::added_error(const Region& one, const Region& other) {
    return error_of_union(one.points, one.sum / one.points, other.points, other.sum / other.points);
}

void RegionGraph::gather(std::uint32_t root_of) {
    Borders& borders = borders_[root_of];
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
    borders.erase(borders.begin() + static_cast<std::ptrdiff_t>(kept), borders.end());
    given_[root_of] = static_cast<std::uint32_t>(kept);
    for (const Border& border : borders)
        place_[border.region] = none;
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
    Neighbour best;
    const double points = regions_[root_of].points;
    const double mean = means_[root_of];
    for (const Border& border : borders_[root_of]) {
        const double cost =
            error_of_union(points, mean, regions_[border.region].points, means_[border.region]) /
            (border.length + own_border_);
        if (best.region == none || cost < best.cost || (cost == best.cost && border.region < best.region))
            best = {border.region, cost};
    }
    cheapest_[root_of] = {best, merges_};
    return best;
}

std::uint32_t RegionGraph::merge(std::uint32_t a, std::uint32_t b) {
    // The shorter list moves, so that no border moves more often than a logarithm says.
    if (given_[a] < given_[b])
        std::swap(a, b);
    sets_.join_into(a, b);
    regions_[a].points += regions_[b].points;
    regions_[a].sum += regions_[b].sum;
    borders_[a].insert(borders_[a].end(), borders_[b].begin(), borders_[b].end());
    given_[a] += given_[b];
    borders_[b] = {};
    means_[a] = regions_[a].sum / regions_[a].points;
    changed_[a] = changed_[b] = ++merges_;
    return a;
}

}  // namespace d2b
