#include "ground/progressive_opening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/grid.hpp"
#include "raster/rank_filter.hpp"

namespace d2b::ground {
namespace {

constexpr double max_radius_in_cells = 30;
constexpr double limit_slope = 0.5;
constexpr std::int32_t max_reach = 60;  ///< or the reach of a single element if that is larger

Radius in_cells(double metres, const CellSize& cell) {
    return {static_cast<std::int32_t>(std::lround(metres / cell.down)),
            static_cast<std::int32_t>(std::lround(metres / cell.across))};
}

double smaller_side(const CellSize& cell) {
    return std::min(cell.across, cell.down);
}

/// Returns the number of cells around a cell that affect its opened value, along rows, columns or diagonals.
std::int32_t reach_of(std::span<const StructuringElement> steps) {
    std::int32_t sum = 0;
    for (const StructuringElement& step : steps)
        sum += 2 * std::max(step.radius.down, step.radius.across);
    return sum;
}

/// Lowers the limits of cells that one opening, from `old` to `now`, lowered by more than `rise`.
void lower_limits(std::span<float> limits, const float* old, const float* now, float rise) {
    for (std::size_t j = 0; j < limits.size(); ++j) {
        const float limit = now[j] + rise;
        const float lower = limit < limits[j] ? limit : limits[j];
        limits[j] = old[j] > limit ? lower : limits[j];
    }
}

/// Calls use(begin, end, rise) for ranges of columns in a row of a part with the height of objects there.
template <typename Use>
void for_column_ranges(const OpenedPart& part, const StructuringElement& step, std::int32_t i,
                       const Use& use) {
    const std::int32_t row = part.tile.row + i;
    const std::int32_t cols = part.tile.cols;
    const bool beside = row < step.border.down || row >= part.grid_rows - step.border.down;
    const std::int32_t left = beside ? cols : std::clamp(step.border.across - part.tile.col, 0, cols);
    const std::int32_t right = std::clamp(part.grid_cols - step.border.across - part.tile.col, left, cols);
    const auto use_if_any = [&](std::int32_t begin, std::int32_t end, float rise) {
        if (begin < end)
            use(static_cast<std::size_t>(begin), static_cast<std::size_t>(end), rise);
    };
    use_if_any(0, left, step.border_rise);
    use_if_any(left, right, step.rise);
    use_if_any(right, cols, step.border_rise);
}

void set_limits(OpenedPart& part, const StructuringElement& step) {
    for (std::int32_t i = 0; i < part.tile.rows; ++i)
        for_column_ranges(part, step, i, [&](std::size_t begin, std::size_t end, float rise) {
            lower_limits(part.limits.row(i).subspan(begin, end - begin),
                         part.row(part.surface, i).data() + begin, part.row(part.next, i).data() + begin,
                         rise);
        });
}

/// Same for whole steps. Converts to metres only chunks with a cell that may have been lowered by as much.
D2B_MULTIVERSION void set_quantized_limits(OpenedPart& part, const StructuringElement& step) {
    constexpr std::size_t piece = 64;
    const QuantizedElevations& values = part.quantized;
    std::array<float, piece> old{};
    std::array<float, piece> now{};
    for (std::int32_t i = 0; i < part.tile.rows; ++i) {
        const auto before = part.row(values.surface, i);
        const auto after = part.row(values.next, i);
        const auto limits = part.limits.row(i);
        for_column_ranges(part, step, i, [&](std::size_t begin, std::size_t end, float rise) {
            const int least = values.guaranteed_steps(rise);
            for (std::size_t first = begin; first < end; first += piece) {
                const std::size_t n = std::min(piece, end - first);
                int cut = 0;
                for (std::size_t j = first; j < first + n; ++j)
                    cut |= before[j] - after[j] > least ? 1 : 0;
                if (cut == 0)
                    continue;
                values.to_metres(before.subspan(first, n), old.data());
                values.to_metres(after.subspan(first, n), now.data());
                lower_limits(limits.subspan(first, n), old.data(), now.data(), rise);
            }
        });
    }
}

void open_quantized(OpenedPart& part, std::span<const StructuringElement> steps, ElementShape element) {
    QuantizedElevations& values = part.quantized;
    values.workspace.gaps = values.gaps;
    for (const StructuringElement& step : steps) {
        open(element, values.surface, step.radius, step.outside, values.workspace, values.next);
        set_quantized_limits(part, step);
        std::swap(values.surface, values.next);
    }
}

void lower_row(std::span<const float> by, std::span<float> limits) {
    for (std::size_t j = 0; j < limits.size(); ++j)
        limits[j] = std::min(limits[j], by[j]);
}

/// Returns the first elements of a series, as many as tiles can be opened by with limited surroundings.
std::span<const StructuringElement> first_elements(std::span<const StructuringElement> steps) {
    std::size_t count = 1;
    while (count < steps.size() && reach_of(steps.first(count + 1)) <= max_reach)
        ++count;
    return steps.first(count);
}

/// Opens a grid by all elements of a series. @return opened grid; empty if there are no elements
/// @param limits set if there are elements @param beside is emptied once it was done
MetreGrid open_grid(const MetreGrid& surface, std::span<const StructuringElement> steps, ElementShape element,
                    MetreGrid& limits, Executor& threads, std::function<void()>& beside) {
    const std::vector<Tile> tiles = tiles_of(surface.rows, surface.cols, tile_side);
    MetreGrid left;
    MetreGrid into;
    while (!steps.empty()) {
        const std::span<const StructuringElement> now = first_elements(steps);
        const bool begins = left.size() == 0;
        const MetreGrid& from = begins ? surface : left;
        if (into.size() == 0)
            into = MetreGrid::unset(surface.rows, surface.cols, threads);
        const std::function<void()> first = std::exchange(beside, {});
        const std::size_t before = first ? 1 : 0;
        threads.for_each_with_scratch<OpenedPart>(
            before + tiles.size(), [&](std::size_t t, OpenedPart& part) {
                if (t < before)
                    return first();
                const Tile& tile = tiles[t - before];
                open_part(from, tile, now, element, part);
                for (std::int32_t i = 0; i < tile.rows; ++i) {
                    part.write_row(i, into.row(tile.row + i).data() + tile.col);
                    const auto lowered = part.limits.row(i);
                    const auto here =
                        limits.row(tile.row + i).subspan(static_cast<std::size_t>(tile.col), lowered.size());
                    if (begins)
                        std::ranges::copy(lowered, here.begin());
                    else
                        lower_row(lowered, here);
                }
            });
        std::swap(left, into);
        steps = steps.subspan(now.size());
    }
    return left;
}

void lower_limits(MetreGrid& limits, const AlignedGrid& fine, const AlignedGrid& coarse,
                  const MetreGrid& coarse_limits, Executor& threads) {
    const MetreGrid around = spread_limits(coarse_limits, coarse.cell, threads);
    for_row_bands(threads, limits.rows, limits.cols, [&](RowBand band) {
        std::vector<float> spread(static_cast<std::size_t>(limits.cols));
        for (std::int32_t i = band.begin; i < band.end; ++i) {
            const std::int32_t row = block_of(fine.first_row + i, twice.down) - coarse.first_row;
            copy_blocks_to_cells(around.row(row), fine.first_col, twice.across, spread);
            lower_row(spread, limits.row(i));
        }
    });
}

}  // namespace

MetreGrid spread_limits(const MetreGrid& limits, const CellSize& cell, Executor& threads) {
    MetreGrid around = minimum_3x3(limits, threads);
    const auto rise = static_cast<float>(limit_slope * smaller_side(cell));
    for_rows(threads, limits.rows, limits.cols, [&](std::int32_t i) {
        for (float& limit : around.row(i))
            limit += rise;
        lower_row(limits.row(i), around.row(i));
    });
    return around;
}

ElementSeries element_series(const OpeningParameters& elements, const CellSize& cell) {
    ElementSeries series{{}, elements.radius};
    const Radius border = in_cells(elements.border_reach, cell);
    double& radius = series.next_radius;
    while (radius <= elements.last_radius * 1.0001) {
        Radius cells = in_cells(radius, cell);
        cells = {std::max(cells.down, 1), std::max(cells.across, 1)};
        const double rise = elements.rise + elements.slope * radius;
        series.steps.push_back({cells,
                                {cells.down - border.down, cells.across - border.across},
                                static_cast<float>(rise),
                                in_cells(elements.border_width, cell),
                                static_cast<float>(elements.border_share * rise)});
        radius = std::max(radius + smaller_side(cell), radius * elements.growth);
    }
    return series;
}

void OpenedPart::write_row(std::int32_t i, float* out) const {
    if (is_quantized)
        quantized.to_metres(row(quantized.surface, i), out);
    else
        std::ranges::copy(row(surface, i), out);
}

void open_part(const MetreGrid& surface, const Tile& tile, std::span<const StructuringElement> steps,
               ElementShape element, OpenedPart& part) {
    part.tile = tile;
    part.place = widened(tile, reach_of(steps), surface);
    part.grid_rows = surface.rows;
    part.grid_cols = surface.cols;
    part.limits.rows = tile.rows;
    part.limits.cols = tile.cols;
    part.limits.values.assign(part.limits.index(tile.rows, 0), no_value);
    part.is_quantized = part.quantized.take(surface, part.place);
    if (part.is_quantized)
        return open_quantized(part, steps, element);
    copy_tile(surface, part.place, part.surface);
    part.workspace.gaps = part.quantized.gaps;
    for (const StructuringElement& step : steps) {
        open(element, part.surface, step.radius, step.outside, part.workspace, part.next);
        set_limits(part, step);
        std::swap(part.surface, part.next);
    }
}

MetreGrid limits_on_blocks(const AlignedGrid& surface, const OpeningParameters& elements,
                           ElementShape element, Executor& threads, std::function<void()> beside) {
    std::vector<AlignedGrid> levels{without_values(surface)};
    std::vector<MetreGrid> limits;
    const MetreGrid* cells = &surface.grid;
    MetreGrid blocks;
    OpeningParameters here = elements;
    for (;;) {
        const CellSize& size = levels.back().cell;
        here.last_radius = std::min(elements.last_radius, max_radius_in_cells * smaller_side(size));
        const ElementSeries series = element_series(here, size);
        limits.push_back(series.steps.empty() ? MetreGrid(cells->rows, cells->cols, no_value, threads)
                                              : MetreGrid::unset(cells->rows, cells->cols, threads));
        MetreGrid left = open_grid(*cells, series.steps, element, limits.back(), threads, beside);
        here.radius = series.next_radius;
        if (here.radius > elements.last_radius * 1.0001)
            break;
        AlignedGrid coarse =
            block_minima(levels.back(), series.steps.empty() ? *cells : left, twice, threads);
        levels.push_back(without_values(coarse));
        blocks = std::move(coarse.grid);
        cells = &blocks;
    }
    if (beside)  // there were no elements
        beside();
    for (std::size_t k = levels.size(); k-- > 1;)
        lower_limits(limits[k - 1], levels[k - 1], levels[k], limits[k], threads);
    return std::move(limits.front());
}

}  // namespace d2b::ground
