#include "ground/ground.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "ground/aligned_grid.hpp"
#include "ground/gap_filling.hpp"
#include "ground/initial_terrain.hpp"
#include "ground/low_outliers.hpp"
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
