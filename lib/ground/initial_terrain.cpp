#include "ground/initial_terrain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/grid.hpp"
#include "ground/connected_ground.hpp"
#include "ground/gap_filling.hpp"
#include "ground/progressive_opening.hpp"
#include "raster/rank_filter.hpp"

namespace d2b::ground {
namespace {

constexpr float above_all_limits = std::numeric_limits<float>::infinity();
constexpr float below_all_elevations = -std::numeric_limits<float>::infinity();

/// Surface opened by small elements, but `above_all_limits` in cells of small objects, and the minimum of
/// each block of the opened surface.
struct OpenedSurface {
    MetreGrid surface;
    AlignedGrid blocks;
    double next_radius = 0;
};

/// Returns the cells of a tile of blocks.
Tile cells_of(const Tile& tile, const AlignedGrid& fine, const AlignedGrid& blocks, BlockSize factor) {
    const std::int32_t row = (blocks.first_row + tile.row) * factor.down - fine.first_row;
    const std::int32_t col = (blocks.first_col + tile.col) * factor.across - fine.first_col;
    const Tile cells{std::max(row, 0), std::max(col, 0), 0, 0};
    return {cells.row, cells.col, std::min(row + tile.rows * factor.down, fine.grid.rows) - cells.row,
            std::min(col + tile.cols * factor.across, fine.grid.cols) - cells.col};
}

OpenedSurface open_small(const AlignedGrid& surface, BlockSize factor, const OpeningParameters& elements,
                         Executor& threads) {
    const ElementSeries series = element_series(elements, surface.cell);
    OpenedSurface result{MetreGrid::unset(surface.grid.rows, surface.grid.cols, threads),
                         blocks_of(surface, factor, no_value, threads), series.next_radius};
    MetreGrid& blocks = result.blocks.grid;
    // Limits the side, because near a pole cells in degrees are so narrow that a block is wider than a tile.
    const std::int32_t side = std::max(tile_side / std::max(factor.down, factor.across), 1);
    const std::vector<Tile> tiles = tiles_of(blocks.rows, blocks.cols, side);
    threads.for_each_with_scratch<OpenedPart>(tiles.size(), [&](std::size_t t, OpenedPart& part) {
        const Tile cells = cells_of(tiles[t], surface, result.blocks, factor);
        open_part(surface.grid, cells, series.steps, ElementShape::rectangle, part);
        std::vector<float> opened(static_cast<std::size_t>(cells.cols));
        for (std::int32_t i = 0; i < cells.rows; ++i) {
            part.write_row(i, opened.data());
            const auto limits = part.limits.row(i);
            const float* z = surface.grid.row(cells.row + i).data() + cells.col;
            float* out = result.surface.row(cells.row + i).data() + cells.col;
            for (std::size_t j = 0; j < opened.size(); ++j) {
                const float left = opened[j];  // read unconditionally, so that the loop needs no branch
                out[j] = z[j] <= limits[j] ? left : above_all_limits;
            }
            const std::int32_t row =
                block_of(surface.first_row + cells.row + i, factor.down) - result.blocks.first_row;
            lower_blocks_to_minima(opened, surface.first_col + cells.col, factor.across,
                                   blocks.row(row).subspan(static_cast<std::size_t>(tiles[t].col),
                                                           static_cast<std::size_t>(tiles[t].cols)));
        }
    });
    return result;
}

/// Fills blocks without a point from the lowest neighbour, so that ground and lines continue between sparse
/// points.
void close_gaps(MetreGrid& grid, Executor& threads) {
    const MetreGrid around = minimum_3x3(grid, threads);
    for_row_bands(threads, grid.rows, grid.cols, [&](RowBand band) {
        for (std::size_t k = grid.index(band.begin, 0); k < grid.index(band.end, 0); ++k)
            grid.values[k] = grid.values[k] == no_value ? around.values[k] : grid.values[k];
    });
}

/// Steepest slope between ground blocks. A step of `wall_rise` within two blocks is a wall, so half of it
/// within one block is not.
double link_slope(const CellSize& block, const Rules& rules) {
    return std::max(rules.link_slope, rules.wall_rise / 2 / std::max(block.across, block.down));
}

/// Computes the height up to which cells are ground, per block: below the limit of large objects, or
/// connected to the ground and low enough by the openings along lines.
MetreGrid block_limits(AlignedGrid& blocks, double next_radius, double width, const Rules& rules,
                       Executor& threads) {
    close_gaps(blocks.grid, threads);
    OpeningParameters elements{next_radius,        rules.reach * width, rules.large_rise,
                               rules.large_slope,  rules.large_growth,  rules.border_reach,
                               rules.large_border, rules.border_share};
    MetreGrid sure = limits_on_blocks(blocks, elements, ElementShape::rectangle, threads);
    // Runs the single-threaded growth of ground while the other threads open by lines.
    Grid<std::uint8_t> ground;
    Mask roofs;
    const auto follow_ground = [&] {
        ground = connected_ground(blocks, sure, link_slope(blocks.cell, rules), rules.link_steps, threads);
        roofs = enclosed_plateaus(blocks, sure, ground, rules, rules.wall_length * width);
        remove_enclosed_by_walls(blocks, sure, rules, rules.wall_length * width, ground, threads);
    };
    elements.rise = rules.line_rise;
    elements.slope = rules.line_slope;
    elements.border_share = 1;
    const MetreGrid lines =
        spread_limits(limits_on_blocks(blocks, elements, ElementShape::lines, threads, follow_ground),
                      blocks.cell, threads);
    sure = spread_limits(sure, blocks.cell, threads);
    const auto rise = static_cast<float>(rules.link_rise);
    for_row_bands(threads, sure.rows, sure.cols, [&](RowBand band) {
        for (std::size_t k = sure.index(band.begin, 0); k < sure.index(band.end, 0); ++k) {
            const float connected = std::min(lines.values[k], blocks.grid.values[k] + rise);
            const float limit = std::max(sure.values[k], connected);
            sure.values[k] = ground.values[k] != 0 ? limit : sure.values[k];
            sure.values[k] = roofs.values[k] != 0 ? below_all_elevations : sure.values[k];
        }
    });
    return sure;
}

void repeat_ground_test(const AlignedGrid& surface, AlignedGrid& terrain, const Rules& rules,
                        Executor& threads) {
    const auto near = static_cast<float>(rules.tolerance);
    const auto nearer = static_cast<float>(rules.tolerance_slope);
    for_bands_with_halo(threads, terrain.grid, 1, [&](const HaloBand<float>& old) {
        std::vector<float> slopes(static_cast<std::size_t>(old.rows.cols));
        for (std::int32_t i = old.band.begin; i < old.band.end; ++i) {
            slopes_of_row(old.rows, i - old.first, terrain.cell, slopes);
            const auto ground = old.rows.row(i - old.first);
            const auto z = surface.grid.row(i);
            const auto out = terrain.grid.row(i);
            for (std::size_t j = 0; j < out.size(); ++j)
                out[j] = z[j] - ground[j] <= near + nearer * slopes[j] ? z[j] : no_value;
        }
    });
}

}  // namespace

AlignedGrid remove_objects(const AlignedGrid& surface, double width, const Rules& rules, Executor& threads) {
    const double cell = std::min(surface.cell.across, surface.cell.down);
    const OpeningParameters elements{cell,
                                     rules.small_radius,
                                     0,
                                     rules.small_slope,
                                     rules.small_growth,
                                     rules.border_reach,
                                     rules.small_border,
                                     rules.border_share};
    const BlockSize factor = block_size_for(surface.cell, rules.block);
    OpenedSurface small = open_small(surface, factor, elements, threads);
    AlignedGrid& blocks = small.blocks;
    const MetreGrid limits = block_limits(blocks, small.next_radius, width, rules, threads);
    AlignedGrid ground = without_values(surface);
    ground.grid = std::move(small.surface);
    for_row_bands(threads, ground.grid.rows, ground.grid.cols, [&](RowBand band) {
        std::vector<float> limit(static_cast<std::size_t>(ground.grid.cols));
        for (std::int32_t i = band.begin; i < band.end; ++i) {
            const std::int32_t row = block_of(surface.first_row + i, factor.down) - blocks.first_row;
            copy_blocks_to_cells(limits.row(row), surface.first_col, factor.across, limit);
            const auto cells = surface.grid.row(i);
            const auto out = ground.grid.row(i);
            for (std::size_t j = 0; j < out.size(); ++j) {
                const float z = cells[j];  // read unconditionally, so that the loop needs no branch
                out[j] = out[j] <= limit[j] ? z : no_value;
            }
        }
    });
    return ground;
}

AlignedGrid working_terrain(const AlignedGrid& surface, double width, const Rules& rules, Executor& threads) {
    AlignedGrid terrain = remove_objects(surface, width, rules, threads);
    Pyramid pyramid;
    fill_gaps(terrain, rules.relaxations, pyramid, threads);
    for (int round = 0; round < rules.rounds; ++round) {
        repeat_ground_test(surface, terrain, rules, threads);
        fill_gaps(terrain, rules.relaxations, pyramid, threads);
    }
    return terrain;
}

void slopes_of_row(const MetreGrid& terrain, std::int32_t row, const CellSize& cell,
                   std::span<float> slopes) {
    const std::int32_t above = std::max(row - 1, 0);
    const std::int32_t below = std::min(row + 1, terrain.rows - 1);
    const float down = below > above ? 1.0F / static_cast<float>((below - above) * cell.down) : 0.0F;
    const auto north = terrain.row(above);
    const auto south = terrain.row(below);
    const auto here = terrain.row(row);
    const auto slope = [&](std::size_t left, std::size_t j, std::size_t right, float across) {
        const float y = (south[j] - north[j]) * down;
        const float x = (here[right] - here[left]) * across;
        slopes[j] = std::sqrt(x * x + y * y);
    };
    const std::size_t last = slopes.size() - 1;
    const float beside = 1.0F / static_cast<float>(cell.across);
    const float twice_beside = 1.0F / static_cast<float>(2 * cell.across);
    for (std::size_t j = 1; j < last; ++j)
        slope(j - 1, j, j + 1, twice_beside);
    slope(0, 0, std::min<std::size_t>(1, last), last > 0 ? beside : 0.0F);
    slope(last - std::min<std::size_t>(1, last), last, last, last > 0 ? beside : 0.0F);
}

}  // namespace d2b::ground
