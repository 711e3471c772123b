#include "contours/merge_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "contours/region_adjacency_graph.hpp"
#include "core/disjoint_sets.hpp"

namespace d2b::contours {

/// Visits the cells of a building in scan order with their preceding neighbours. Holds two rows that move
/// down the building's columns.
class NeighbourScan {
  public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// @param stop checked at each run, because one building may fill a whole raster
    NeighbourScan(const BuildingCells& cells, const StopToken& stop) : cells_(cells), stop_(stop) {
        std::int32_t end = 0;
        for (const RowSpan& run : cells.runs) {
            first_ = std::min(first_, run.begin);
            end = std::max(end, run.end);
        }
        above_.resize(cells.runs.empty() ? 0 : static_cast<std::size_t>(end - first_));
    }

    /// Calls use(cell, left, up, up_left) with the indices of cells in scan order, or `none`.
    template <typename Use>
    void for_each(const Use& use) {
        std::uint32_t cell = 0;
        for (const RowSpan& run : cells_.runs) {
            stop_.check();
            std::uint32_t left = none;
            std::uint32_t up_left = run.begin > first_ ? above(run.row, run.begin - 1) : none;
            for (std::int32_t col = run.begin; col < run.end; ++col, ++cell) {
                const std::uint32_t up = above(run.row, col);
                use(cell, left, up, up_left);
                Seen& here = above_[static_cast<std::size_t>(col - first_)];
                here = {run.row, cell, here.row, here.cell};
                left = cell;
                up_left = up;
            }
        }
    }

  private:
    /// Last two cells of a column.
    struct Seen {
        std::int32_t row = std::numeric_limits<std::int32_t>::min();
        std::uint32_t cell = none;
        std::int32_t row_before = std::numeric_limits<std::int32_t>::min();
        std::uint32_t cell_before = none;
    };
    [[nodiscard]] std::uint32_t above(std::int32_t row, std::int32_t col) const {
        const Seen& seen = above_[static_cast<std::size_t>(col - first_)];
        if (seen.row == row - 1)
            return seen.cell;
        return seen.row == row && seen.row_before == row - 1 ? seen.cell_before : none;
    }

    const BuildingCells& cells_;
    const StopToken& stop_;
    std::int32_t first_ = std::numeric_limits<std::int32_t>::max();
    std::vector<Seen> above_;
};

/// Points of a region and their mean.
struct MeanRegion {
    double points = 0;
    double sum = 0;   ///< sum of elevations
    double mean = 0;  ///< undefined without points

    void add(const MeanRegion& other) {
        points += other.points;
        sum += other.sum;
        mean = sum / points;
    }
    /// Squared error added by merging two regions.
    [[nodiscard]] static double added_error(const MeanRegion& one, const MeanRegion& other) {
        if (one.points == 0 || other.points == 0)
            return 0;
        const double step = one.mean - other.mean;
        return one.points * other.points / (one.points + other.points) * step * step;
    }
};

using TierGraph = RegionAdjacencyGraph<MeanRegion>;

namespace {

constexpr std::array<double, 8> shares_of_price{1.0 / 256, 1.0 / 64, 1.0 / 16, 1.0 / 8,
                                                1.0 / 4,   1.0 / 2,  3.0 / 4,  1.0};
// Limit of rounds. Rounds are repeated, because two narrow regions may form a wide one together.
constexpr int most_rounds = 8;

/// Initial regions: neighbours that hardly differ, joined during a scan. Most cells are joined here, which
/// saves a graph of all cells.
class Seeds {
  public:
    Seeds(const BuildingCells& cells, double price, const StopToken& stop)
        : sets_(static_cast<std::uint32_t>(cells.elevations.size())), sums_(sets_.size()) {
        for (std::size_t i = 0; i < sums_.size(); ++i)
            if (!std::isnan(cells.elevations[i]))
                sums_[i] = {1, cells.elevations[i], cells.elevations[i]};
        NeighbourScan(cells, stop)
            .for_each([&](std::uint32_t cell, std::uint32_t left, std::uint32_t up, std::uint32_t) {
                for (const std::uint32_t beside : {left, up})
                    if (beside != NeighbourScan::none)
                        join(beside, cell, price);
            });
    }
    [[nodiscard]] std::uint32_t root(std::uint32_t cell) { return sets_.find(cell); }
    [[nodiscard]] const MeanRegion& of(std::uint32_t root) const { return sums_[root]; }

  private:
    void join(std::uint32_t one, std::uint32_t other, double price) {
        one = root(one);
        other = root(other);
        if (one == other || MeanRegion::added_error(sums_[one], sums_[other]) > price)
            return;
        const auto [low, high] = std::minmax(one, other);
        sets_.merge_roots(low, high);
        sums_[low].add(sums_[high]);
    }

    DisjointSets sets_;
    std::vector<MeanRegion> sums_;
};

/// Region adjacency graph, and the initial region of each cell.
struct Image {
    std::vector<std::uint32_t> first;  ///< by cell
    TierGraph graph;

    [[nodiscard]] std::uint32_t region(std::uint32_t cell) { return graph.root(first[cell]); }
};

Image first_image(const BuildingCells& cells, const RegionOptions& options, const StopToken& stop) {
    Seeds seeds(cells, shares_of_price.front() * options.price, stop);
    std::vector<std::uint32_t> number(cells.elevations.size());
    std::vector<MeanRegion> regions;
    for (std::uint32_t cell = 0; cell < number.size(); ++cell) {
        const std::uint32_t root = seeds.root(cell);  // first cell of the region
        if (root == cell) {
            number[cell] = static_cast<std::uint32_t>(regions.size());
            regions.push_back(seeds.of(root));
        } else {
            number[cell] = number[root];
        }
    }
    Image image{std::move(number), TierGraph(std::move(regions), options.own_border)};
    NeighbourScan(cells, stop)
        .for_each([&](std::uint32_t cell, std::uint32_t left, std::uint32_t up, std::uint32_t) {
            for (const std::uint32_t beside : {left, up})
                if (beside != NeighbourScan::none && image.first[beside] != image.first[cell])
                    image.graph.add_border(image.first[beside], image.first[cell], 1);
        });
    return image;
}

/// Flags the regions that contain a square of the given width.
std::vector<bool> wide_regions(const BuildingCells& cells, Image& image, int width, const StopToken& stop) {
    std::vector<bool> wide(image.graph.size());
    /// Largest square within a region whose lower right corner is a cell.
    struct Corner {
        std::uint32_t region = TierGraph::none;
        std::int32_t side = 1;
    };
    std::vector<Corner> corners(cells.elevations.size());
    NeighbourScan(cells, stop)
        .for_each([&](std::uint32_t cell, std::uint32_t left, std::uint32_t up, std::uint32_t up_left) {
            const std::uint32_t region = image.region(cell);
            const auto within = [&](std::uint32_t other) {
                return other != NeighbourScan::none && corners[other].region == region ? corners[other].side
                                                                                       : 0;
            };
            const std::int32_t side = 1 + std::min({within(left), within(up), within(up_left)});
            corners[cell] = {region, side};
            if (side >= width)
                wide[region] = true;
        });
    return wide;
}

void merge_narrow(const BuildingCells& cells, Image& image, int width, const StopToken& stop) {
    TierGraph& graph = image.graph;
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
            const TierGraph::Neighbour neighbour = graph.cheapest(region);
            if (neighbour.region == TierGraph::none)
                continue;
            graph.merge(region, neighbour.region);
            merged = true;
        }
        if (!merged)
            return;
    }
}

TierRegions numbered(Image& image) {
    const TierGraph& graph = image.graph;
    TierRegions result;
    result.of_cell.resize(image.first.size());
    std::vector<std::uint32_t> number(graph.size(), TierGraph::none);
    for (std::uint32_t cell = 0; cell < result.of_cell.size(); ++cell) {
        const std::uint32_t root = image.region(cell);
        if (number[root] == TierGraph::none) {
            number[root] = static_cast<std::uint32_t>(result.regions.size());
            const MeanRegion& region = graph.of(root);
            result.regions.push_back({static_cast<std::int64_t>(region.points),
                                      region.points > 0 ? region.sum / region.points : 0});
        }
        result.of_cell[cell] = number[root];
    }
    return result;
}

}  // namespace

TierRegions merge_regions(const BuildingCells& cells, const RegionOptions& options, const StopToken& stop) {
    Image image = first_image(cells, options, stop);
    merge_with_rising_prices(image.graph, shares_of_price, options.price, stop);
    merge_narrow(cells, image, options.least_width, stop);
    return numbered(image);
}

}  // namespace d2b::contours
