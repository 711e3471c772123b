#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "core/disjoint_sets.hpp"
#include "core/stop_token.hpp"

namespace d2b::contours {

/// Region adjacency graph whose regions are merged, with the lengths of their common borders.
///
/// @tparam Region the model fitted to the elevations of a region, as sums that can be added: has a member
/// `void add(const Region&)`, and `static double added_error(const Region&, const Region&)` returns the
/// squared error added by merging two regions, at least 0
template <typename Region>
class RegionAdjacencyGraph {
  public:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    /// @param own_border border in cells that each region has in addition to its actual one
    explicit RegionAdjacencyGraph(std::vector<Region> regions, double own_border = 0);

    /// Adds a border. Repeated calls for the same two regions add up.
    /// @param length length in cells
    void add_border(std::uint32_t a, std::uint32_t b, std::uint32_t length);

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(regions_.size()); }
    [[nodiscard]] std::uint32_t root(std::uint32_t region) { return sets_.find(region); }
    [[nodiscard]] bool is_root(std::uint32_t region) const { return sets_.is_root(region); }
    [[nodiscard]] const Region& of(std::uint32_t root) const { return regions_[root]; }

    struct Neighbour {
        std::uint32_t region = none;
        double cost = 0;  ///< cost of merging: added squared error per length of the removed border,
                          ///< including a region's own one
    };
    /// Returns the cheapest neighbour to merge with; the lowest index in case of a tie. Cached until the
    /// region or a neighbour changes.
    [[nodiscard]] Neighbour cheapest(std::uint32_t root);
    /// @return the root of both
    std::uint32_t merge(std::uint32_t a, std::uint32_t b);

  private:
    struct Border {
        std::uint32_t region = none;
        std::uint32_t length = 0;
    };
    /// Cached cheapest neighbour, and the number of merges at that time; none if not cached.
    struct Cheapest {
        Neighbour neighbour;
        std::uint32_t merges = none;
    };
    [[nodiscard]] bool still_holds(std::uint32_t root) const;
    /// Merges the borders with the same neighbour.
    void merge_duplicate_borders(std::uint32_t root);

    /// Borders of a region. Most regions have few, which need no heap allocation: the average of a planar
    /// graph is below six.
    using Borders = boost::container::small_vector<Border, 10>;

    double own_border_;
    std::vector<Region> regions_;
    DisjointSets sets_;
    std::vector<Borders> borders_;
    std::vector<std::uint32_t>
        given_;  ///< number of borders as added, which determines the list that is moved
    std::vector<Cheapest> cheapest_;
    std::vector<std::uint32_t> changed_;  ///< number of merges when it last grew or was merged
    std::uint32_t merges_ = 0;
    std::vector<std::uint32_t>
        place_;  ///< scratch of merge_duplicate_borders(): index of a neighbour in the list of borders
};

template <typename Region>
RegionAdjacencyGraph<Region>::RegionAdjacencyGraph(std::vector<Region> regions, double own_border)
    : own_border_(own_border),
      regions_(std::move(regions)),
      sets_(static_cast<std::uint32_t>(regions_.size())),
      borders_(regions_.size()),
      given_(regions_.size(), 0),
      cheapest_(regions_.size()),
      changed_(regions_.size(), 0),
      place_(regions_.size(), none) {}

template <typename Region>
void RegionAdjacencyGraph<Region>::add_border(std::uint32_t a, std::uint32_t b, std::uint32_t length) {
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

template <typename Region>
void RegionAdjacencyGraph<Region>::merge_duplicate_borders(std::uint32_t root_of) {
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

template <typename Region>
bool RegionAdjacencyGraph<Region>::still_holds(std::uint32_t root_of) const {
    const std::uint32_t then = cheapest_[root_of].merges;
    if (then == none || changed_[root_of] > then)
        return false;
    const Borders& borders = borders_[root_of];
    return std::ranges::all_of(borders,
                               [&](const Border& border) { return changed_[border.region] <= then; });
}

template <typename Region>
typename RegionAdjacencyGraph<Region>::Neighbour RegionAdjacencyGraph<Region>::cheapest(
    std::uint32_t root_of) {
    if (still_holds(root_of))
        return cheapest_[root_of].neighbour;
    merge_duplicate_borders(root_of);
    Neighbour best{none, std::numeric_limits<double>::infinity()};
    const Region here = regions_[root_of];
    const double own = own_border_;
    for (const Border& border : borders_[root_of]) {
        place_[border.region] = none;
        const double cost = Region::added_error(here, regions_[border.region]) / (border.length + own);
        const bool better = (cost < best.cost) | ((cost == best.cost) & (border.region < best.region));
        best.cost = better ? cost : best.cost;
        best.region = better ? border.region : best.region;
    }
    cheapest_[root_of] = {best, merges_};
    return best;
}

template <typename Region>
std::uint32_t RegionAdjacencyGraph<Region>::merge(std::uint32_t a, std::uint32_t b) {
    // Moves the shorter list, so that each border moves O(log n) times.
    if (given_[a] < given_[b])
        std::swap(a, b);
    sets_.merge_roots(a, b);
    regions_[a].add(regions_[b]);
    borders_[a].insert(borders_[a].end(), borders_[b].begin(), borders_[b].end());
    given_[a] += given_[b];
    borders_[b] = {};
    changed_[a] = changed_[b] = ++merges_;
    return a;
}

/// Merges each region with its cheapest neighbour while that costs at most the price.
/// @param roots in ascending order; merged ones are removed, because most merge early
template <typename Region>
void merge_up_to(RegionAdjacencyGraph<Region>& graph, double price, std::vector<std::uint32_t>& roots,
                 const StopToken& stop) {
    for (bool merged = true; merged;) {
        merged = false;
        std::size_t kept = 0;
        for (const std::uint32_t region : roots) {
            if (!graph.is_root(region))
                continue;
            roots[kept++] = region;
            stop.check();
            const auto neighbour = graph.cheapest(region);
            if (neighbour.region == RegionAdjacencyGraph<Region>::none || neighbour.cost > price)
                continue;
            graph.merge(region, neighbour.region);
            merged = true;
        }
        roots.resize(kept);
    }
}

/// Merges regions at prices that rise to the requested one, so that the most similar ones are merged first.
/// @param shares of the price, rising
template <typename Region>
void merge_with_rising_prices(RegionAdjacencyGraph<Region>& graph, std::span<const double> shares,
                              double price, const StopToken& stop) {
    std::vector<std::uint32_t> roots(graph.size());
    std::iota(roots.begin(), roots.end(), 0U);
    for (const double share : shares)
        merge_up_to(graph, share * price, roots, stop);
}

}  // namespace d2b::contours
