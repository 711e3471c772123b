#include "detect/smeared_border.hpp"

#include <algorithm>

#include "core/row_bands.hpp"

namespace d2b {
namespace {

constexpr std::int32_t cells_beside = 2;  // cells
constexpr double half = 0.5;

/// Cells of a mask that have cells of it on all four sides.
Mask inside_of(const Mask& cells, Executor& threads) {
    Mask inside = Mask::unset(cells.rows, cells.cols, threads);
    for_row_bands(threads, cells.rows, cells.cols, [&](RowBand band) {
        for (std::int32_t row = band.begin; row < band.end; ++row)
            for (std::int32_t col = 0; col < cells.cols; ++col) {
                const bool on_edge = row == 0 || col == 0 || row + 1 == cells.rows || col + 1 == cells.cols;
                const std::size_t i = cells.index(row, col);
                const auto cols = static_cast<std::size_t>(cells.cols);
                inside.values[i] = on_edge ? 0
                                           : cells.values[i] & cells.values[i - 1] & cells.values[i + 1] &
                                                 cells.values[i - cols] & cells.values[i + cols];
            }
    });
    return inside;
}

/// Whether a cell is less than half as high as the cells inside that are near it are on the average.
bool is_smeared(const Scene& scene, const Mask& inside, std::int32_t row, std::int32_t col) {
    double sum = 0;
    int count = 0;
    for (std::int32_t r = std::max(row - cells_beside, 0); r <= std::min(row + cells_beside, inside.rows - 1);
         ++r)
        for (std::int32_t c = std::max(col - cells_beside, 0);
             c <= std::min(col + cells_beside, inside.cols - 1); ++c)
            if (const std::size_t i = inside.index(r, c); inside.values[i] != 0) {
                sum += static_cast<double>(scene.height(i));
                ++count;
            }
    return static_cast<double>(scene.height(inside.index(row, col))) * count < half * sum;
}

}  // namespace

void take_smeared_border_off(const Scene& scene, Mask& cells, Executor& threads) {
    const Mask inside = inside_of(cells, threads);
    for_row_bands(threads, cells.rows, cells.cols, [&](RowBand band) {
        for (std::int32_t row = band.begin; row < band.end; ++row)
            for (std::int32_t col = 0; col < cells.cols; ++col) {
                const std::size_t i = cells.index(row, col);
                if (cells.values[i] != 0 && inside.values[i] == 0 && is_smeared(scene, inside, row, col))
                    cells.values[i] = 0;
            }
    });
}

}  // namespace d2b
