#include "ground/ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "ground/aligned_grid.hpp"
#include "ground/connected_ground.hpp"
#include "ground/gap_filling.hpp"
#include "ground/low_outliers.hpp"
#include "ground/progressive_opening.hpp"
#include "raster/rank_filter.hpp"

namespace d2b::ground {

/// Grid on which small objects are detected: the lowest points of blocks or, if blocks are cells, the surface
/// itself, whose memory is borrowed until restore(). This saves one grid of the window.
class WorkingSurface {
  public:
    /// @param surface NaN for points that are not valid; must not be used until it is given back
    /// @param shape of the surface
    WorkingSurface(MetreGrid& surface, const AlignedGrid& shape, const GridOrigin& place, BlockSize factor,
                   Executor& threads);

    /// `no_value` if a block has no point.
    [[nodiscard]] const AlignedGrid& lowest() const { return lowest_; }

    /// Removes points below the limits of low outliers.
    void remove(const std::vector<LowOutlier>& low_outliers);
    /// Restores the surface. @param pits low outliers removed by remove()
    void restore(const std::vector<LowOutlier>& low_outliers);

  private:
    [[nodiscard]] float lowest_above(const LowOutlier& outlier) const;

    MetreGrid& surface_;
    GridOrigin place_;
    BlockSize factor_;
    Executor& threads_;
    AlignedGrid lowest_;
    std::vector<float> removed_;  ///< one per low outlier
};

/// Computes the terrain at every point of the surface: points near the working terrain are ground; elsewhere
/// the terrain equals the working terrain but is never above the surface.
/// @param working its memory becomes the result's if its cells are those of the surface
/// @param pits of the working grid, in scan order: points below their limits are low outliers
[[nodiscard]] Terrain refine(const MetreGrid& surface, const GridOrigin& place, AlignedGrid working,
                             const std::vector<LowOutlier>& low_outliers, BlockSize factor,
                             const Rules& rules, Executor& threads);

namespace {

constexpr float above_all_limits = std::numeric_limits<float>::infinity();
constexpr float below_all_elevations = -std::numeric_limits<float>::infinity();

/// Computes the slopes of a row in metres per metre by central differences; one-sided at the border.
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

/// Returns the surface with `no_value` in cells of objects.
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

/// Returns the terrain of the working grid without gaps: points near the provisional terrain are ground (last
/// test of SMRF), the rest is filled again. Memory: 4 bytes per cell, as much as the surface, and at most 7
/// more temporarily.
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

bool is_cell(BlockSize factor) {
    return factor.down == 1 && factor.across == 1;
}

/// Replaces cells for which `is` holds. Chunks without such cells are only read, because writing them would
/// dirty memory needlessly.
template <typename Is>
void replace_where(Executor& threads, MetreGrid& grid, const Is& is, float value) {
    constexpr std::size_t piece = 1024;
    for_cells(threads, grid, [&](std::size_t begin, std::size_t end) {
        for (std::size_t first = begin; first < end; first += piece) {
            const std::span cells(grid.values.data() + first, std::min(piece, end - first));
            int any = 0;
            for (const float z : cells)
                any |= is(z) ? 1 : 0;
            if (any != 0)
                std::ranges::replace_if(cells, is, value);
        }
    });
}

/// Returns the low outliers in a row of the working grid.
std::span<const LowOutlier> low_outliers_in(std::span<const LowOutlier> low_outliers, std::int32_t row) {
    const auto first = std::partition_point(low_outliers.begin(), low_outliers.end(),
                                            [&](const LowOutlier& p) { return p.row < row; });
    const auto last =
        std::partition_point(first, low_outliers.end(), [&](const LowOutlier& p) { return p.row == row; });
    return {first, last};
}

/// Marks points below the limits of outlier cells.
struct OutlierMarker {
    std::span<const LowOutlier> low_outliers;  ///< of the working grid
    std::int32_t first_row;                    ///< of that grid
    std::int32_t first_col;
    BlockSize factor;
    GridOrigin place;

    /// @param below working terrain of the row
    void mark(std::int32_t row, std::span<const float> surface, std::span<const float> below,
              std::span<float> terrain, std::span<std::uint8_t> flags) const {
        for (const LowOutlier& outlier :
             low_outliers_in(low_outliers, block_of(place.row + row, factor.down) - first_row)) {
            const std::int32_t col =
                factor.across * (first_col + outlier.col) - place.col;  // may be negative
            const auto end = std::min(static_cast<std::size_t>(col + factor.across), surface.size());
            for (auto j = static_cast<std::size_t>(std::max(col, 0)); j < end; ++j)
                if (surface[j] < outlier.limit) {
                    terrain[j] = below[j];
                    flags[j] = low_outlier;
                }
        }
    }
};

/// Interpolates terrain and tolerance from the working grid, for a band of rows of the surface.
class Refinement {
  public:
    /// @param working only rows around the band are needed
    /// @param across weights for the columns of the surface
    Refinement(RowBand band, const GridOrigin& place, const AlignedGrid& working, BlockSize factor,
               const Rules& rules, const InterpolationWeights& across)
        : first_(band.begin),
          working_(working),
          factor_(factor),
          rules_(rules),
          down_(place.row + band.begin, band.end - band.begin, working.first_row, working.grid.rows,
                factor.down),
          across_(across) {}

    /// Buffers for rows of the surface and one of the working grid.
    struct Rows {
        std::vector<float> terrain, tolerance, between;
        MetreGrid tolerances;        ///< rows of the working grid ...
        std::int32_t first_row = 0;  ///< ... starting at this one
    };

    [[nodiscard]] Rows rows() const {
        const auto cols = static_cast<std::size_t>(working_.grid.cols);
        Rows rows;
        rows.between.resize(cols);
        rows.first_row = down_[0].near;
        rows.tolerances = MetreGrid(
            down_[static_cast<std::int32_t>(down_.size()) - 1].next - rows.first_row + 1, working_.grid.cols);
        for (std::int32_t i = 0; i < rows.tolerances.rows; ++i) {
            const auto out = rows.tolerances.row(i);
            slopes_of_row(working_.grid, rows.first_row + i, working_.cell, out);
            for (float& value : out)
                value =
                    static_cast<float>(rules_.tolerance) + static_cast<float>(rules_.tolerance_slope) * value;
        }
        return rows;
    }

    void fill(std::int32_t row, Rows& rows) const {
        const InterpolationWeights::Weights& place = down_[row - first_];
        between(working_.grid.row(place.near), working_.grid.row(place.next), place.share, rows.between,
                rows.terrain);
        between(rows.tolerances.row(place.near - rows.first_row),
                rows.tolerances.row(place.next - rows.first_row), place.share, rows.between, rows.tolerance);
    }

  private:
    /// Interpolates a row between two rows of the working grid at the centres of the surface's cells.
    void between(std::span<const float> near, std::span<const float> next, float share,
                 std::vector<float>& row, std::vector<float>& out) const {
        for (std::size_t j = 0; j < row.size(); ++j)
            row[j] = near[j] + share * (next[j] - near[j]);
        out.resize(across_.size());
        if (factor_.across == 1) {
            std::copy(row.begin(), row.end(), out.begin());
            return;
        }
        for (std::size_t j = 0; j < out.size(); ++j) {
            const InterpolationWeights::Weights& place = across_[static_cast<std::int32_t>(j)];
            const float left = row[static_cast<std::size_t>(place.near)];
            out[j] = left + place.share * (row[static_cast<std::size_t>(place.next)] - left);
        }
    }

    std::int32_t first_;  ///< row of the surface
    const AlignedGrid& working_;
    BlockSize factor_;
    const Rules& rules_;
    InterpolationWeights down_;
    const InterpolationWeights& across_;
};

/// @param refinement of the band @param terrain any values
void refine_band(const MetreGrid& surface, RowBand band, const Refinement& refinement,
                 const OutlierMarker& marker, Terrain& terrain) {
    Refinement::Rows rows = refinement.rows();
    for (std::int32_t i = band.begin; i < band.end; ++i) {
        refinement.fill(i, rows);
        const auto from = surface.row(i);
        const auto out = terrain.elevation.row(i);
        const auto flags = terrain.flags.row(i);
        for (std::size_t j = 0; j < out.size(); ++j) {
            const bool bare = from[j] - rows.terrain[j] <= rows.tolerance[j];  // false for NaN
            out[j] = bare ? from[j] : rows.terrain[j];
            flags[j] = bare ? bare_ground : std::uint8_t{0};
        }
        marker.mark(i, from, rows.terrain, out, flags);
    }
}

AlignedGrid shape_at(const MetreGrid& surface, const CellSize& cell, const GridOrigin& place) {
    AlignedGrid shape;
    shape.first_row = place.row;
    shape.first_col = place.col;
    shape.cell = cell;
    shape.grid.rows = surface.rows;
    shape.grid.cols = surface.cols;
    return shape;
}

/// Reach of a series of openings: each depends on cells within twice its radius, rounded up to cells that
/// grow to its size.
double openings_halo(double radius, double last_radius, double growth, double cell) {
    double sum = 0;
    while (radius <= last_radius * 1.0001) {
        sum += 2 * radius + 2 * cell;
        radius = std::max(radius + cell, radius * growth);
    }
    return sum;
}

/// Reach of filling: gaps as wide as twice the distance to the ground are filled from blocks of that size,
/// which depend on the blocks within reach of each level's interpolation and smoothing.
double fill_halo(double distance, double cell, int relaxations) {
    double sum = 0;
    double block = cell;
    while (block < 4 * distance) {
        sum += (3 + relaxations) * block;
        block *= 2;
    }
    return sum;
}

}  // namespace

WorkingSurface::WorkingSurface(MetreGrid& surface, const AlignedGrid& shape, const GridOrigin& place,
                               BlockSize factor, Executor& threads)
    : surface_(surface), place_(place), factor_(factor), threads_(threads) {
    if (!is_cell(factor)) {
        lowest_ = block_minima(shape, surface, factor, threads);
        return;
    }
    lowest_ = shape;
    lowest_.grid = std::move(surface);
    const auto has_none = [](float z) { return !(z < no_value); };  // also true for NaN
    replace_where(threads, lowest_.grid, has_none, no_value);
}

void WorkingSurface::remove(const std::vector<LowOutlier>& low_outliers) {
    removed_.reserve(low_outliers.size());
    for (const LowOutlier& outlier : low_outliers)
        removed_.push_back(std::exchange(lowest_.grid.at(outlier.row, outlier.col), lowest_above(outlier)));
}

void WorkingSurface::restore(const std::vector<LowOutlier>& low_outliers) {
    if (!is_cell(factor_))
        return;
    for (std::size_t i = 0; i < removed_.size(); ++i)
        lowest_.grid.at(low_outliers[i].row, low_outliers[i].col) = removed_[i];
    surface_ = std::move(lowest_.grid);
    const auto has_none = [](float z) { return z == no_value; };
    replace_where(threads_, surface_, has_none, std::numeric_limits<float>::quiet_NaN());
}

/// Returns the lowest point of a cell that is not an outlier, or `no_value`.
float WorkingSurface::lowest_above(const LowOutlier& outlier) const {
    if (is_cell(factor_))
        return no_value;
    const std::int32_t row = factor_.down * (lowest_.first_row + outlier.row) - place_.row;
    const std::int32_t col = factor_.across * (lowest_.first_col + outlier.col) - place_.col;
    float lowest = no_value;
    for (std::int32_t i = std::max(row, 0); i < std::min(row + factor_.down, surface_.rows); ++i)
        for (std::int32_t j = std::max(col, 0); j < std::min(col + factor_.across, surface_.cols); ++j)
            if (const float z = surface_.at(i, j); z >= outlier.limit && z < lowest)
                lowest = z;
    return lowest;
}

Terrain refine(const MetreGrid& surface, const GridOrigin& place, AlignedGrid working,
               const std::vector<LowOutlier>& low_outliers, BlockSize factor, const Rules& rules,
               Executor& threads) {
    const OutlierMarker marker{low_outliers, working.first_row, working.first_col, factor, place};
    const InterpolationWeights across(place.col, surface.cols, working.first_col, working.grid.cols,
                                      factor.across);
    Terrain terrain{{}, Grid<std::uint8_t>::unset(surface.rows, surface.cols, threads)};
    if (factor.down != 1 || factor.across != 1) {
        terrain.elevation = MetreGrid::unset(surface.rows, surface.cols, threads);
        for_row_bands(threads, surface.rows, surface.cols, [&](RowBand band) {
            refine_band(surface, band, Refinement(band, place, working, factor, rules, across), marker,
                        terrain);
        });
        return terrain;
    }
    terrain.elevation = std::move(working.grid);
    // Copies two rows around each band: it needs the next row, whose slope depends on the one after.
    for_bands_with_halo(threads, terrain.elevation, 2, [&](HaloBand<float>& copy) {
        AlignedGrid around = without_values(working);
        around.first_row += copy.first;
        around.grid = std::move(copy.rows);
        refine_band(surface, copy.band, Refinement(copy.band, place, around, factor, rules, across), marker,
                    terrain);
        copy.rows = std::move(around.grid);
    });
    return terrain;
}

Terrain estimate(MetreGrid& surface, const CellSize& cell, double width, const Context& context,
                 const GridOrigin& place, const Rules& rules) {
    if (surface.size() == 0)
        return {};
    Executor& threads = *context.threads;
    const BlockSize factor = block_size_for(cell, rules.work_cell);
    WorkingSurface working(surface, shape_at(surface, cell, place), place, factor, threads);
    const auto known = [](float value) { return value != no_value; };
    if (std::ranges::none_of(working.lowest().grid.values, known)) {
        working.restore({});
        return {MetreGrid(surface.rows, surface.cols, std::numeric_limits<float>::quiet_NaN()),
                Grid<std::uint8_t>(surface.rows, surface.cols)};
    }
    context.progress(0.1);
    const std::vector<LowOutlier> low_outliers = find_low_outliers(working.lowest(), rules, threads);
    working.remove(low_outliers);
    AlignedGrid terrain = working_terrain(working.lowest(), width, rules, threads);
    working.restore(low_outliers);
    context.progress(0.9);
    return refine(surface, place, std::move(terrain), low_outliers, factor, rules, threads);
}

double halo(const CellSize& cell, double width, const Rules& rules) {
    const double side = std::max(cell.across, cell.down);
    const BlockSize small = block_size_for(cell, rules.work_cell);
    const double work = std::max(cell.across * small.across, cell.down * small.down);
    const double block = std::max(work, 2 * rules.block);
    const double widest = rules.reach * width;
    const double low_outliers = 2 * (rules.outlier_radius + work) + rules.outlier_reach + work;
    // Limits of blocks also apply to their neighbours, and blocks of the coarsest level are as large as part
    // of an element.
    const double neighbours = 2 * std::max(widest / 4, block);
    return side + low_outliers + openings_halo(work, rules.small_radius, rules.small_growth, work) +
           openings_halo(rules.small_radius, widest, rules.large_growth, block) + neighbours +
           rules.link_steps * block + rules.wall_length * width + 2 * block +
           (1 + rules.rounds) * (fill_halo(width, work, rules.relaxations) + 2 * work);
}

double ground_halo(const CellSize& cell, const GroundOptions& options) {
    return halo(cell, options.max_building_width, rules_for(cell));
}

Terrain estimate_ground(MetreGrid& surface, const CellSize& cell, const GroundOptions& options,
                        Context& context, const GridOrigin& place) {
    return estimate(surface, cell, options.max_building_width, context, place, rules_for(cell));
}

}  // namespace d2b::ground
