#include "detect/scene_statistics.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "raster/regions.hpp"

namespace d2b::detect {

/// Returns the first bin for NaN. Branch-free, so that the loop vectorises.
std::int32_t GroundFit::bin_of(double height) {
    const double bin = (height + highest_m) / bin_m;
    constexpr double last = bins - 1;
    const double not_below = bin > 0 ? bin : 0;
    return static_cast<std::int32_t>(not_below < last ? not_below : last);
}

D2B_MULTIVERSION void GroundFit::find_bins(std::span<const float> surface, std::span<const float> ground,
                                           std::span<std::int32_t> found) {
    std::int32_t known = 0;
    std::int32_t bare = 0;
    for (std::size_t i = 0; i < surface.size(); ++i) {
        const float height = surface[i] - ground[i];
        known += height == height ? 1 : 0;
        bare += height <= min_height_ ? 1 : 0;
        const std::int32_t bin = bin_of(static_cast<double>(height));
        found[i] = height == height ? bin : unknown;
    }
    cells_ += known;
    bare_ += bare;
}

void GroundFit::add(std::span<const float> surface, std::span<const float> ground) {
    constexpr std::size_t piece = 256;
    std::array<std::int32_t, piece> found{};
    for (std::size_t first = 0; first < surface.size(); first += piece) {
        const std::size_t n = std::min(piece, surface.size() - first);
        find_bins(surface.subspan(first, n), ground.subspan(first, n), found);
        for (std::size_t i = 0; i < n; ++i)
            if (found[i] != unknown)
                ++counts_[static_cast<std::size_t>(found[i])];
    }
}

void GroundFit::merge(const GroundFit& other) {
    cells_ += other.cells_;
    bare_ += other.bare_;
    for (std::size_t i = 0; i < bins; ++i)
        counts_[i] += other.counts_[i];
}

double GroundFit::bare_share() const {
    return cells_ == 0 ? 1 : static_cast<double>(bare_) / static_cast<double>(cells_);
}

double GroundFit::share_above(double height) const {
    const auto first = counts_.begin() + bin_of(height);
    const std::int64_t above = std::accumulate(first, counts_.end(), std::int64_t{0});
    return cells_ == 0 ? 0 : static_cast<double>(above) / static_cast<double>(cells_);
}

double GroundFit::middle(std::int64_t cells) const {
    if (cells == 0)
        return std::numeric_limits<double>::quiet_NaN();
    std::int64_t below = 0;
    std::size_t bin = 0;
    while (2 * (below + counts_[bin]) < cells)
        below += counts_[bin++];
    return (static_cast<double>(bin) + 0.5) * bin_m - highest_m;
}

namespace {

void add_fit(const MetreGrid& surface, const MetreGrid& ground, const Window& cells, GroundFit& fit,
             Executor& threads) {
    const auto col = static_cast<std::size_t>(cells.col);
    const auto cols = static_cast<std::size_t>(cells.cols);
    const auto add_row = [&](std::int32_t r, GroundFit& some) {
        some.add(surface.row(cells.row + r).subspan(col, cols), ground.row(cells.row + r).subspan(col, cols));
    };
    fit.merge(reduce_rows(threads, cells.rows, cells.cols, GroundFit(fit.min_height()), add_row));
}

constexpr std::int64_t least_missing = 20;  // at least one in this many cells
Mask known_cells(const MetreGrid& surface, const Window& own, Executor& threads) {
    Mask known = Mask::unset(own.rows, own.cols, threads);
    for_rows(threads, own.rows, own.cols, [&](std::int32_t r) {
        const float* row = surface.row(own.row + r).data() + own.col;
        std::ranges::transform(row, row + own.cols, known.row(r).data(),
                               [](float z) { return static_cast<std::uint8_t>(z == z ? 1 : 0); });
    });
    return known;
}

/// True if the part of the grids has a cell with a valid surface and a value that counts. Stops at the first.
template <typename T, typename Counts>
bool any_known(const MetreGrid& surface, const Grid<T>& grid, const Window& cells, const Counts& counts) {
    for (std::int32_t r = cells.row; r < cells.end_row(); ++r)
        for (std::size_t i = grid.index(r, cells.col); i < grid.index(r, cells.end_col()); ++i)
            if (!std::isnan(surface.values[i]) && counts(grid.values[i]))
                return true;
    return false;
}

}  // namespace

void add_slope(const MetreGrid& ground, const CellSize& cell, std::int32_t first_row, const Window& cells,
               GroundSlope& slope, Executor& threads) {
    constexpr std::int32_t every = 16;
    const auto end_col = static_cast<std::size_t>(std::min(cells.end_col(), ground.cols - 1));
    const auto add_row = [&](std::int32_t row, GroundSlope& sum) {
        const std::int32_t r = cells.row + row;
        if ((first_row + r) % every != 0)
            return;
        const auto here = ground.row(r);
        const auto below = ground.row(r + 1);
        for (auto c = static_cast<std::size_t>(cells.col); c < end_col; ++c)
            sum.add(static_cast<double>(here[c + 1] - here[c]) / cell.across,
                    static_cast<double>(below[c] - here[c]) / cell.down);
    };
    const std::int32_t rows = std::min(cells.end_row(), ground.rows - 1) - cells.row;
    slope.merge(reduce_rows(threads, rows, ground.cols, GroundSlope(), add_row));
}

void ValidIslands::merge(const ValidIslands& other) {
    cells += other.cells;
    narrow += other.narrow;
    islands += other.islands;
    largest = std::max(largest, other.largest);
}

void add_islands(const MetreGrid& surface, const CellSize& cell, const Window& own, double min_area_m2,
                 double max_width_m, ValidIslands& islands, Executor& threads) {
    const Mask known = known_cells(surface, own, threads);
    const std::int64_t cells = std::ranges::count(known.values, std::uint8_t{1});
    ValidIslands here{cells, 0, 0, 0};
    if (least_missing * (own.points() - cells) >= own.points()) {
        const Regions regions = connected_regions(known, 1, cells_covering(min_area_m2, cell), threads);
        const std::vector<CellBox> boxes = bounding_boxes(regions);
        for (Label label = 1; label < boxes.size(); ++label) {
            const CellBox& box = boxes[label];
            if (std::min(box.rows() * cell.down * cell.sine, box.cols() * cell.across) > max_width_m)
                continue;
            here.narrow += regions.cells[label];
            ++here.islands;
            here.largest = std::max(here.largest, regions.cells[label]);
        }
    }
    islands.merge(here);
}

void SceneStatistics::add_ground(const MetreGrid& surface, const MetreGrid& ground, const CellSize& cell,
                                 std::int32_t first_row, const Window& own, Executor& threads) {
    add_fit(surface, ground, own, fit, threads);
    add_slope(ground, cell, first_row, own, slope, threads);
}

void SceneStatistics::add_buildings(const Scene& scene, const Detection& detection, const Window& own,
                                    Executor& threads) {
    sides.mask =
        sides.mask || scene.allowed == nullptr ||
        any_known(scene.surface, *scene.allowed, own, [](std::uint8_t allowed) { return allowed != 0; });
    sides.ndvi =
        sides.ndvi || scene.greenness == nullptr ||
        any_known(scene.surface, *scene.greenness, own, [](float value) { return !std::isnan(value); });
    if (scene.parcels != nullptr)
        add_fit(scene, detection, own, parcels, threads);
    add_sampling(scene, detection, fit.min_height(), own, sampling, threads);
}

void SceneStatistics::merge(const SceneStatistics& other) {
    fit.merge(other.fit);
    slope.merge(other.slope);
    sides.merge(other.sides);
    parcels.merge(other.parcels);
    sampling.merge(other.sampling);
    islands.merge(other.islands);
}

}  // namespace d2b::detect
