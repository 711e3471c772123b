#include "detect/smeared_border.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/row_bands.hpp"
#include "detect/mask_runs.hpp"

namespace d2b {
namespace {

constexpr std::int32_t cells_beside = 2;
constexpr double half = 0.5;

/// Returns the cells of a mask whose four neighbours belong to it as well.
Mask inside_of(const Mask& cells, Executor& threads) {
    Mask inside = Mask::unset(cells.rows, cells.cols, threads);
    for_row_bands(threads, cells.rows, cells.cols, [&](RowBand band) {
        for (std::int32_t row = band.begin; row < band.end; ++row) {
            const std::span<std::uint8_t> out = inside.row(row);
            if (row == 0 || row + 1 == cells.rows) {
                std::fill(out.begin(), out.end(), std::uint8_t{0});
                continue;
            }
            const std::span<const std::uint8_t> here = cells.row(row);
            const std::span<const std::uint8_t> above = cells.row(row - 1);
            const std::span<const std::uint8_t> below = cells.row(row + 1);
            for (std::size_t c = 1; c + 1 < out.size(); ++c)
                out[c] = here[c] & here[c - 1] & here[c + 1] & above[c] & below[c];
            out.front() = out.back() = 0;
        }
    });
    return inside;
}

/// True if a cell is less than half as high as the nearby inner cells on average.
bool is_smeared(const Scene& scene, const Mask& inside, std::int32_t row, std::int32_t col) {
    double sum = 0;
    int count = 0;
    const std::int32_t left = std::max(col - cells_beside, 0);
    const std::int32_t right = std::min(col + cells_beside, inside.cols - 1);
    for (std::int32_t r = std::max(row - cells_beside, 0); r <= std::min(row + cells_beside, inside.rows - 1);
         ++r) {
        const std::uint8_t* const within = inside.row(r).data();
        const float* const z = scene.surface.row(r).data();
        const float* const ground = scene.terrain.row(r).data();
        for (std::int32_t c = left; c <= right; ++c)
            if (within[c] != 0) {
                sum += static_cast<double>(z[c] - ground[c]);
                ++count;
            }
    }
    return static_cast<double>(scene.height(inside.index(row, col))) * count < half * sum;
}

}  // namespace

void take_smeared_border_off(const Scene& scene, Mask& cells, Executor& threads) {
    const Mask inside = inside_of(cells, threads);
    for_row_bands(threads, cells.rows, cells.cols, [&](RowBand band) {
        std::vector<std::uint8_t> border(static_cast<std::size_t>(cells.cols));
        for (std::int32_t row = band.begin; row < band.end; ++row) {
            const std::span<std::uint8_t> here = cells.row(row);
            const std::span<const std::uint8_t> within = inside.row(row);
            std::uint8_t* const out = border.data();
            for (std::size_t c = 0; c < here.size(); ++c)
                out[c] = here[c] ^ within[c];  // inner cells are cells, too
            for_mask_runs(border, 1, [&](std::int32_t begin, std::int32_t end) {
                for (std::int32_t col = begin; col < end; ++col)
                    if (is_smeared(scene, inside, row, col))
                        here[static_cast<std::size_t>(col)] = 0;
            });
        }
    });
}

}  // namespace d2b
