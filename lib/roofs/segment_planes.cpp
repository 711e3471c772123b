#include "roofs/segment_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "contours/region_adjacency_graph.hpp"

namespace d2b::roofs {
namespace {

/// Residual from which a point has no weight in a fit.
constexpr double fitted_residual_m = 0.3;
/// Share of a cell's own elevation in its first moments; the rest comes from the window around it that fits a
/// plane best, because cells without neighbours have no slope.
constexpr double own_share = 0.5;
constexpr int segment_rounds = 3;
constexpr int fit_rounds = 4;
constexpr int relax_sweeps = 6;
constexpr std::size_t fewest_cells = 6;

struct PlaneRegion {
    PlaneMoments moments;
    double error = 0;

    void add(const PlaneRegion& other) {
        moments.add(other.moments);
        error = moments.error();
    }
    [[nodiscard]] static double added_error(const PlaneRegion& one, const PlaneRegion& other) {
        PlaneMoments both = one.moments;
        both.add(other.moments);
        return std::max(0.0, both.error() - one.error - other.error);
    }
};

using PlaneGraph = contours::RegionAdjacencyGraph<PlaneRegion>;

/// Compact numbers of the cells of a building.
class CellNumbers {
  public:
    explicit CellNumbers(const BuildingGrid& grid) : grid_(grid), numbers_(grid.size(), PlaneGraph::none) {
        for (std::size_t i = 0; i < grid.size(); ++i)
            if (grid.inside[i] != 0) {
                numbers_[i] = static_cast<std::uint32_t>(cells_.size());
                cells_.push_back(i);
            }
    }
    [[nodiscard]] const std::vector<std::size_t>& cells() const { return cells_; }
    /// Calls use(number, number) for each two neighbours.
    template <typename Use>
    void for_neighbours(const Use& use) const {
        const auto width = static_cast<std::size_t>(grid_.cols);
        for (std::uint32_t n = 0; n < cells_.size(); ++n) {
            const std::size_t i = cells_[n];
            // The grid has a margin, so each cell has all neighbours.
            for (const std::size_t beside : {i - 1, i - width})
                if (numbers_[beside] != PlaneGraph::none)
                    use(numbers_[beside], n);
        }
    }

  private:
    const BuildingGrid& grid_;
    std::vector<std::uint32_t> numbers_;
    std::vector<std::size_t> cells_;
};

/// Moments of the windows of 3 x 3 valid cells, by their middle cell.
struct Windows {
    std::vector<PlaneMoments> moments;
    std::vector<double> errors;  ///< infinite where there is no window
};

Windows plane_windows(const BuildingGrid& grid, const CellNumbers& numbers) {
    Windows windows{std::vector<PlaneMoments>(grid.size()),
                    std::vector<double>(grid.size(), std::numeric_limits<double>::infinity())};
    const auto width = static_cast<std::size_t>(grid.cols);
    for (const std::size_t i : numbers.cells()) {
        PlaneMoments sum;
        bool whole = true;
        for (const std::size_t row : {i - width, i, i + width})
            for (const std::size_t cell : {row - 1, row, row + 1}) {
                const double z = grid.elevation(cell);
                whole = whole && !std::isnan(z);
                const auto [x, y] = grid.centre(cell);
                sum.add(x, y, z, 1.0 / 9);
            }
        if (!whole)
            continue;
        windows.moments[i] = sum;
        windows.errors[i] = sum.error();
    }
    return windows;
}

std::vector<PlaneRegion> first_regions(const BuildingGrid& grid, const CellNumbers& numbers) {
    const Windows windows = plane_windows(grid, numbers);
    const auto width = static_cast<std::size_t>(grid.cols);
    std::vector<PlaneRegion> regions;
    regions.reserve(numbers.cells().size());
    for (const std::size_t i : numbers.cells()) {
        PlaneRegion& region = regions.emplace_back();
        const double z = grid.elevation(i);
        if (std::isnan(z))
            continue;
        std::size_t best = i;
        for (const std::size_t row : {i - width, i, i + width})
            for (const std::size_t cell : {row - 1, row, row + 1})
                if (windows.errors[cell] < windows.errors[best])
                    best = cell;
        const auto [x, y] = grid.centre(i);
        const bool has_window = std::isfinite(windows.errors[best]);
        region.moments.add(x, y, z, has_window ? own_share : 1);
        if (has_window)
            region.moments.add(windows.moments[best], 1 - own_share);
        region.error = region.moments.error();
    }
    return regions;
}

/// Renumbers the regions of cells from 0 in scan order.
std::vector<std::int32_t> numbered(PlaneGraph& graph, const std::vector<std::uint32_t>& first,
                                   const CellNumbers& numbers, std::size_t size) {
    std::vector<std::int32_t> labels(size, -1);
    std::vector<std::int32_t> number(graph.size(), -1);
    std::int32_t next = 0;
    for (std::size_t n = 0; n < first.size(); ++n) {
        std::int32_t& label = number[graph.root(first[n])];
        if (label < 0)
            label = next++;
        labels[numbers.cells()[n]] = label;
    }
    return labels;
}

constexpr std::array<double, 12> shares_of_price{1.0 / 16384, 1.0 / 4096, 1.0 / 1024, 1.0 / 256,
                                                 1.0 / 64,    1.0 / 32,   1.0 / 16,   1.0 / 8,
                                                 1.0 / 4,     1.0 / 2,    3.0 / 4,    1.0};

std::vector<std::int32_t> merge_cells(const BuildingGrid& grid, const CellNumbers& numbers, double price,
                                      const StopToken& stop) {
    PlaneGraph graph(first_regions(grid, numbers));
    numbers.for_neighbours([&](std::uint32_t a, std::uint32_t b) { graph.add_border(a, b, 1); });
    contours::merge_with_rising_prices(graph, shares_of_price, price, stop);
    std::vector<std::uint32_t> first(numbers.cells().size());
    std::iota(first.begin(), first.end(), 0U);
    return numbered(graph, first, numbers, grid.size());
}

/// Numbers the connected parts of equal labels, by number of a cell.
DisjointSets::Numbers connected_parts(const std::vector<std::int32_t>& labels, const CellNumbers& numbers) {
    DisjointSets sets(static_cast<std::uint32_t>(numbers.cells().size()));
    numbers.for_neighbours([&](std::uint32_t a, std::uint32_t b) {
        if (labels[numbers.cells()[a]] == labels[numbers.cells()[b]])
            sets.join(a, b);
    });
    return sets.numbered();
}

/// Merges small regions with the neighbours that suit them best, and then those that cost less than the
/// price.
void tidy(const BuildingGrid& grid, const CellNumbers& numbers, double price, double min_cells,
          std::vector<std::int32_t>& labels, const StopToken& stop) {
    const DisjointSets::Numbers connected = connected_parts(labels, numbers);
    const std::vector<std::uint32_t>& parts = connected.of;
    std::vector<PlaneRegion> regions(connected.count);
    std::vector<std::uint32_t> sizes(connected.count);
    for (std::size_t n = 0; n < parts.size(); ++n) {
        const std::size_t i = numbers.cells()[n];
        ++sizes[parts[n]];
        if (const double z = grid.elevation(i); !std::isnan(z)) {
            const auto [x, y] = grid.centre(i);
            regions[parts[n]].moments.add(x, y, z);
        }
    }
    for (PlaneRegion& region : regions)
        region.error = region.moments.error();
    PlaneGraph graph(std::move(regions));
    numbers.for_neighbours([&](std::uint32_t a, std::uint32_t b) {
        if (parts[a] != parts[b])
            graph.add_border(parts[a], parts[b], 1);
    });
    std::vector<std::uint32_t> small;
    for (std::uint32_t part = 0; part < connected.count; ++part)
        if (sizes[part] < min_cells)
            small.push_back(part);
    std::ranges::stable_sort(small, {}, [&](std::uint32_t part) { return sizes[part]; });
    for (const std::uint32_t part : small) {
        if (!graph.is_root(part) || sizes[part] >= min_cells)
            continue;
        const auto neighbour = graph.cheapest(part);
        if (neighbour.region == PlaneGraph::none)
            continue;
        const std::uint32_t both = sizes[part] + sizes[neighbour.region];
        sizes[graph.merge(part, neighbour.region)] = both;
    }
    contours::merge_with_rising_prices(graph, shares_of_price, price, stop);
    labels = numbered(graph, parts, numbers, grid.size());
}

/// Relaxation of labels: cells get those of neighbours whose planes suit them better.
class Relaxation {
  public:
    /// @param price squared metres of a cell per side of a cell
    Relaxation(const BuildingGrid& grid, const std::vector<Plane>& planes, double price,
               std::vector<std::int32_t>& labels)
        : grid_(grid), planes_(planes), price_(price), labels_(labels) {
        constexpr double side = 0.4142;    // of the length of a border beside a cell
        constexpr double corner = 0.2929;  // and across its corner: nearly independent of direction
        const auto width = static_cast<std::ptrdiff_t>(grid.cols);
        neighbours_ = {{{-width - 1, corner},
                        {-width, side},
                        {-width + 1, corner},
                        {-1, side},
                        {1, side},
                        {width - 1, corner},
                        {width, side},
                        {width + 1, corner}}};
    }
    /// @return true if the label of a cell changed
    bool relax(std::size_t cell) {
        collect(cell);
        if (count_ == 1)
            return false;
        const auto [x, y] = grid_.centre(cell);
        const double z = grid_.elevation(cell);
        double least = std::numeric_limits<double>::infinity();
        std::int32_t best = labels_[cell];
        for (std::size_t k = 0; k < count_; ++k) {
            const Plane& plane = planes_[static_cast<std::size_t>(candidates_[k].label)];
            const double residual = std::isnan(z) ? 0 : z - plane.at(x, y);
            const double cost = residual * residual + price_ * (total_ - candidates_[k].weight);
            if (cost < least - 1e-12) {
                least = cost;
                best = candidates_[k].label;
            }
        }
        return std::exchange(labels_[cell], best) != best;
    }

  private:
    struct Neighbour {
        std::ptrdiff_t offset;
        double weight;
    };
    struct Candidate {
        std::int32_t label;
        double weight;
    };
    /// Collects the labels of a cell and its neighbours with the lengths of their borders.
    void collect(std::size_t cell) {
        candidates_[0] = {labels_[cell], 0};
        count_ = 1;
        total_ = 0;
        for (const Neighbour& neighbour : neighbours_) {
            const auto beside =
                static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) + neighbour.offset);
            const std::int32_t label = labels_[beside];
            if (label < 0)
                continue;
            total_ += neighbour.weight;
            const auto end = candidates_.begin() + static_cast<std::ptrdiff_t>(count_);
            const auto known = std::find_if(candidates_.begin(), end,
                                            [label](const Candidate& c) { return c.label == label; });
            if (known == end)
                candidates_[count_++] = {label, neighbour.weight};
            else
                known->weight += neighbour.weight;
        }
    }

    const BuildingGrid& grid_;
    const std::vector<Plane>& planes_;
    double price_;
    std::vector<std::int32_t>& labels_;
    std::array<Neighbour, 8> neighbours_{};
    std::array<Candidate, 9> candidates_{};
    std::size_t count_ = 0;
    double total_ = 0;
};

/// Relaxes the labels of all cells in turn (iterated conditional modes).
void relax(const BuildingGrid& grid, const CellNumbers& numbers, const std::vector<Plane>& planes,
           double price, std::vector<std::int32_t>& labels) {
    Relaxation relaxation(grid, planes, price, labels);
    const std::vector<std::size_t>& cells = numbers.cells();
    for (int sweep = 0; sweep < relax_sweeps; ++sweep) {
        bool changed = false;
        for (std::size_t k = 0; k < cells.size(); ++k)
            changed = relaxation.relax(cells[sweep % 2 == 0 ? k : cells.size() - 1 - k]) || changed;
        if (!changed)
            return;
    }
}

std::size_t label_count(const std::vector<std::int32_t>& labels) {
    return static_cast<std::size_t>(std::ranges::max(labels)) + 1;
}

}  // namespace

std::vector<Plane> fit_planes(const BuildingGrid& grid, const std::vector<std::int32_t>& labels,
                              std::size_t count) {
    constexpr double least_weight = 0.001;
    constexpr double largest_share = 1.5;  // of the root mean square
    std::vector<Plane> planes(count);
    std::vector<double> limits(count);
    for (int round = 0; round < fit_rounds; ++round) {
        std::vector<PlaneMoments> sums(count);
        for (std::size_t i = 0; i < labels.size(); ++i) {
            const double z = grid.elevation(i);
            if (labels[i] < 0 || std::isnan(z))
                continue;
            const auto label = static_cast<std::size_t>(labels[i]);
            const auto [x, y] = grid.centre(i);
            double weight = 1;
            if (round > 0) {
                const double u = (z - planes[label].at(x, y)) / limits[label];
                weight = u * u < 1 ? (1 - u * u) * (1 - u * u) : least_weight;
            }
            sums[label].add(x, y, z, weight);
        }
        for (std::size_t i = 0; i < count; ++i) {
            planes[i] = sums[i].fit();
            // A few cells of ground tilt the first planes by so much that hardly any cell is near them.
            const double rms = std::sqrt(sums[i].error() / std::max(sums[i].weight(), 1.0));
            limits[i] = std::max(fitted_residual_m, largest_share * rms);
        }
    }
    return planes;
}

PlaneSegments segment_planes(const BuildingGrid& grid, const SegmentOptions& options, const StopToken& stop) {
    const CellNumbers numbers(grid);
    const double price = options.price_m3 / grid.cell_m;  // squared metres of a cell per side of a cell
    const double cell_m2 = grid.cell_m * grid.cell_m;
    const double min_cells = std::max<double>(fewest_cells, std::round(options.min_area_m2 / cell_m2));
    PlaneSegments segments;
    segments.labels = merge_cells(grid, numbers, price, stop);
    tidy(grid, numbers, price, min_cells, segments.labels, stop);
    for (int round = 0; round < segment_rounds; ++round) {
        stop.check();
        segments.planes = fit_planes(grid, segments.labels, label_count(segments.labels));
        relax(grid, numbers, segments.planes, price, segments.labels);
        tidy(grid, numbers, price, min_cells, segments.labels, stop);
    }
    segments.planes = fit_planes(grid, segments.labels, label_count(segments.labels));
    return segments;
}

}  // namespace d2b::roofs
