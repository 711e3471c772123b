#include "diagnose/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/grid.hpp"
#include "detect/regions.hpp"
#include "diagnose/warnings.hpp"

namespace d2b {
namespace {

constexpr std::int64_t least_missing = 20;  // at least one in this many cells
/// Minimum number of pieces, because one or two may be a small cut-out of a surface.
constexpr std::int64_t fewest_islands = 3;

struct Box {
    std::int32_t first_row;
    std::int32_t end_row;
    std::int32_t begin;
    std::int32_t end;
};

Mask known_cells(const MetreGrid& surface, const Window& own, Executor& threads) {
    Mask known = Mask::unset(own.rows, own.cols, threads);
    for_row_bands(threads, own.rows, own.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r) {
            const float* row = surface.row(own.row + r).data() + own.col;
            std::ranges::transform(row, row + own.cols, known.row(r).data(),
                                   [](float z) { return static_cast<std::uint8_t>(z == z ? 1 : 0); });
        }
    });
    return known;
}

std::vector<Box> boxes_of(const Regions& regions) {
    std::vector<Box> boxes(regions.cells.size(), Box{-1, 0, 0, 0});
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r)) {
            Box& box = boxes[run.label];
            if (box.first_row < 0)
                box = {r, r + 1, run.begin, run.end};
            box.end_row = r + 1;
            box.begin = std::min(box.begin, run.begin);
            box.end = std::max(box.end, run.end);
        }
    return boxes;
}

}  // namespace

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
        const std::vector<Box> boxes = boxes_of(regions);
        for (Label label = 1; label < boxes.size(); ++label) {
            const Box& box = boxes[label];
            if (std::min((box.end_row - box.first_row) * cell.down * cell.sine,
                         (box.end - box.begin) * cell.across) > max_width_m)
                continue;
            here.narrow += regions.cells[label];
            ++here.islands;
            here.largest = std::max(here.largest, regions.cells[label]);
        }
    }
    islands.merge(here);
}

std::string missing_ground_warning(const ValidIslands& islands, GroundMode mode, const std::string& dem) {
    if (mode != GroundMode::automatic || !islands.narrow_most() || islands.islands < fewest_islands ||
        2 * islands.largest > islands.cells)
        return {};
    return "'" + dem + "' has elevations in " + std::to_string(islands.islands) +
           " pieces as wide as buildings and NoData around them, so roofs are taken for the ground; give "
           "-ground none where its values are heights above the ground, or a terrain model with -ground "
           "where "
           "they are elevations";
}

namespace {

template <typename T, typename Counts>
bool any_known(const MetreGrid& surface, const Grid<T>& grid, const Window& cells, const Counts& counts) {
    for (std::int32_t r = cells.row; r < cells.end_row(); ++r)
        for (std::size_t i = grid.index(r, cells.col); i < grid.index(r, cells.end_col()); ++i)
            if (!std::isnan(surface.values[i]) && counts(grid.values[i]))
                return true;
    return false;
}

}  // namespace

bool has_value_on_surface(const MetreGrid& surface, const Mask& mask, const Window& cells) {
    return any_known(surface, mask, cells, [](std::uint8_t allowed) { return allowed != 0; });
}

bool has_value_on_surface(const MetreGrid& surface, const MetreGrid& values, const Window& cells) {
    return any_known(surface, values, cells, [](float value) { return !std::isnan(value); });
}

std::string empty_auxiliary_warning(const AuxiliaryCoverage& known, const Options& options) {
    if (!known.terrain)
        return "the terrain '" + options.ground.terrain +
               "' has no valid cell over the DEM; give one of the same place with -ground, or leave -ground "
               "out to have the ground estimated";
    if (!known.mask)
        return "the mask '" + options.detect.mask +
               "' has no cell over the DEM that is neither 0 nor NoData; give one with -mask that marks "
               "where "
               "buildings may be";
    return {};
}

std::string terrain_gap_warning(const TerrainGap& gap, const std::string& dem, const std::string& terrain) {
    const std::int64_t missing = gap.cells - gap.known;
    // The share outside is measured on a lattice of points.
    const std::int64_t told = gap.outside + gap.outside / 50;
    if (gap.known == 0 || missing < gap.fewest || missing <= told)
        return {};
    return percent(static_cast<double>(missing) / static_cast<double>(gap.cells)) + " of the cells of '" +
           dem + "' that have an elevation have none in the terrain '" + terrain +
           "'; there is no ground there, and buildings are cut off or missing, so fill its NoData, for "
           "example "
           "with gdal_fillnodata.py, or leave -ground out to have the ground estimated";
}

std::string ndvi_warning(const AuxiliaryCoverage& known, const Options& options) {
    if (known.ndvi)
        return {};
    return "the NDVI '" + options.detect.ndvi +
           "' has no valid cell over the DEM, so it shows no plants; give one of the same place with -ndvi";
}

}  // namespace d2b
