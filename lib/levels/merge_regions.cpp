#include "levels/merge_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "levels/cell_neighbours.hpp"
#include "levels/region_graph.hpp"

namespace d2b {
namespace {

// Prices rise to the requested one, so that the most similar regions are merged first.
constexpr std::array<double, 8> shares_of_price{1.0 / 256, 1.0 / 64, 1.0 / 16, 1.0 / 8,
                                                1.0 / 4,   1.0 / 2,  3.0 / 4,  1.0};
// Limit of rounds. Rounds are repeated, because two narrow regions may form a wide one together.
constexpr int most_rounds = 8;

/// Initial regions: neighbours that hardly differ, joined during a scan. Most cells are joined here, which
/// saves a graph of all cells.
class Seeds {
  public:
    Seeds(const BuildingCells& cells, double price, const StopRequest& stop)
        : sets_(static_cast<std::uint32_t>(cells.elevations.size())), sums_(sets_.size()) {
        for (std::size_t i = 0; i < sums_.size(); ++i)
            if (!std::isnan(cells.elevations[i]))
                sums_[i] = {1, cells.elevations[i], cells.elevations[i]};
        CellNeighbours(cells, stop)
            .for_each([&](std::uint32_t cell, std::uint32_t left, std::uint32_t up, std::uint32_t) {
                for (const std::uint32_t beside : {left, up})
                    if (beside != CellNeighbours::none)
                        join(beside, cell, price);
            });
    }
    [[nodiscard]] std::uint32_t root(std::uint32_t cell) { return sets_.find(cell); }
    [[nodiscard]] const RegionGraph::Region& of(std::uint32_t root) const { return sums_[root]; }

  private:
    void join(std::uint32_t one, std::uint32_t other, double price) {
        one = root(one);
        other = root(other);
        if (one == other || RegionGraph::added_error(sums_[one], sums_[other]) > price)
            return;
        const auto [low, high] = std::minmax(one, other);
        sets_.join_into(low, high);
        sums_[low].add(sums_[high]);
    }

    DisjointSets sets_;
    std::vector<RegionGraph::Region> sums_;
};

/// Region adjacency graph, and the initial region of each cell.
struct Image {
    std::vector<std::uint32_t> first;  ///< by cell
    RegionGraph graph;

    [[nodiscard]] std::uint32_t region(std::uint32_t cell) { return graph.root(first[cell]); }
};

Image first_image(const BuildingCells& cells, const RegionOptions& options, const StopRequest& stop) {
    Seeds seeds(cells, shares_of_price.front() * options.price, stop);
    std::vector<std::uint32_t> number(cells.elevations.size());
    std::vector<RegionGraph::Region> regions;
    for (std::uint32_t cell = 0; cell < number.size(); ++cell) {
        const std::uint32_t root = seeds.root(cell);  // first cell of the region
        if (root == cell) {
            number[cell] = static_cast<std::uint32_t>(regions.size());
            regions.push_back(seeds.of(root));
        } else {
            number[cell] = number[root];
        }
    }
    Image image{std::move(number), RegionGraph(std::move(regions), options.own_border)};
    CellNeighbours(cells, stop)
        .for_each([&](std::uint32_t cell, std::uint32_t left, std::uint32_t up, std::uint32_t) {
            for (const std::uint32_t beside : {left, up})
                if (beside != CellNeighbours::none && image.first[beside] != image.first[cell])
                    image.graph.add_border(image.first[beside], image.first[cell], 1);
        });
    return image;
}

/// Merges each region with its cheapest neighbour while that costs at most the price.
/// @param roots in ascending order; merged ones are removed, because most merge early
void merge_up_to(RegionGraph& graph, double price, std::vector<std::uint32_t>& roots,
                 const StopRequest& stop) {
    for (bool merged = true; merged;) {
        merged = false;
        std::size_t kept = 0;
        for (const std::uint32_t region : roots) {
            if (!graph.is_root(region))
                continue;
            roots[kept++] = region;
            stop.check();
            const RegionGraph::Neighbour neighbour = graph.cheapest(region);
            if (neighbour.region == RegionGraph::none || neighbour.cost > price)
                continue;
            graph.merge(region, neighbour.region);
            merged = true;
        }
        roots.resize(kept);
    }
}

/// Flags the regions that contain a square of the given width.
std::vector<bool> wide_regions(const BuildingCells& cells, Image& image, int width, const StopRequest& stop) {
    std::vector<bool> wide(image.graph.size());
    /// Largest square within a region whose lower right corner is a cell.
    struct Corner {
        std::uint32_t region = RegionGraph::none;
        std::int32_t side = 1;
    };
    std::vector<Corner> corners(cells.elevations.size());
    CellNeighbours(cells, stop)
        .for_each([&](std::uint32_t cell, std::uint32_t left, std::uint32_t up, std::uint32_t up_left) {
            const std::uint32_t region = image.region(cell);
            const auto within = [&](std::uint32_t other) {
                return other != CellNeighbours::none && corners[other].region == region ? corners[other].side
                                                                                        : 0;
            };
            const std::int32_t side = 1 + std::min({within(left), within(up), within(up_left)});
            corners[cell] = {region, side};
            if (side >= width)
                wide[region] = true;
        });
    return wide;
}

void merge_narrow(const BuildingCells& cells, Image& image, int width, const StopRequest& stop) {
    RegionGraph& graph = image.graph;
    for (int round = 0; width > 1 && round < most_rounds; ++round) {
        const std::vector<bool> wide = wide_regions(cells, image, width, stop);
        std::vector<std::uint32_t> narrow;
        for (std::uint32_t region = 0; region < graph.size(); ++region)
            if (graph.is_root(region) && !wide[region])
                narrow.push_back(region);
        std::ranges::stable_sort(narrow, {}, [&](std::uint32_t region) { return graph.of(region).points; });
        bool merged = false;
        for (const std::uint32_t region : narrow) {
            if (!graph.is_root(region))
                continue;
            const RegionGraph::Neighbour neighbour = graph.cheapest(region);
            if (neighbour.region == RegionGraph::none)
                continue;
            graph.merge(region, neighbour.region);
            merged = true;
        }
        if (!merged)
            return;
    }
}

TierRegions numbered(Image& image) {
    const RegionGraph& graph = image.graph;
    TierRegions result;
    result.of_cell.resize(image.first.size());
    std::vector<std::uint32_t> number(graph.size(), RegionGraph::none);
    for (std::uint32_t cell = 0; cell < result.of_cell.size(); ++cell) {
        const std::uint32_t root = image.region(cell);
        if (number[root] == RegionGraph::none) {
            number[root] = static_cast<std::uint32_t>(result.regions.size());
            const RegionGraph::Region& region = graph.of(root);
            result.regions.push_back({static_cast<std::int64_t>(region.points),
                                      region.points > 0 ? region.sum / region.points : 0});
        }
        result.of_cell[cell] = number[root];
    }
    return result;
}

}  // namespace

TierRegions merge_regions(const BuildingCells& cells, const RegionOptions& options, const StopRequest& stop) {
    Image image = first_image(cells, options, stop);
    std::vector<std::uint32_t> roots(image.graph.size());
    std::iota(roots.begin(), roots.end(), 0U);
    for (const double share : shares_of_price)
        merge_up_to(image.graph, share * options.price, roots, stop);
    merge_narrow(cells, image, options.least_width, stop);
    return numbered(image);
}

}  // namespace d2b
