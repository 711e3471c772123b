#include "detect/roof_samples.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace d2b {
namespace {

constexpr std::int32_t square_cells = 1024;
constexpr std::size_t most_samples = 4;

struct Square {
    std::int32_t row;
    std::int32_t col;
    std::int32_t rows;
    std::int32_t cols;
    std::int64_t roofs;  ///< cells
};

template <typename T>
Grid<T> cut(const Grid<T>& grid, const Square& square, Executor& threads) {
    auto part = Grid<T>::unset(square.rows, square.cols, threads);
    for (std::int32_t r = 0; r < square.rows; ++r)
        std::copy_n(grid.row(square.row + r).begin() + square.col, square.cols, part.row(r).begin());
    return part;
}

template <typename T>
std::optional<Grid<T>> cut(const Grid<T>* grid, const Square& square, Executor& threads) {
    return grid != nullptr ? std::optional(cut(*grid, square, threads)) : std::nullopt;
}

std::int64_t roofs_in(const Mask& roofs, const Square& square) {
    std::int64_t cells = 0;
    for (std::int32_t r = square.row; r < square.row + square.rows; ++r) {
        const auto begin = roofs.row(r).begin() + square.col;
        cells = std::accumulate(begin, begin + square.cols, cells);
    }
    return cells;
}

std::vector<Square> squares_of(const Mask& roofs) {
    std::vector<Square> squares;
    for (std::int32_t r = 0; r < roofs.rows; r += square_cells)
        for (std::int32_t c = 0; c < roofs.cols; c += square_cells) {
            Square square{r, c, std::min(square_cells, roofs.rows - r),
                          std::min(square_cells, roofs.cols - c), 0};
            square.roofs = roofs_in(roofs, square);
            if (square.roofs > 0)
                squares.push_back(square);
        }
    return squares;
}

}  // namespace

std::vector<RoofSample> roof_samples(const Scene& scene, const Mask& roofs, Executor& threads) {
    std::vector<Square> squares = squares_of(roofs);
    std::stable_sort(squares.begin(), squares.end(),
                     [](const Square& a, const Square& b) { return a.roofs > b.roofs; });
    squares.resize(std::min(squares.size(), most_samples));
    std::vector<RoofSample> samples(squares.size());
    threads.for_each(squares.size(), [&](std::size_t i) {
        const Square& square = squares[i];
        samples[i] = {cut(scene.surface, square, threads),
                      cut(scene.terrain, square, threads),
                      scene.cell,
                      cut(scene.allowed, square, threads),
                      cut(scene.greenness, square, threads),
                      cut(roofs, square, threads)};
    });
    return samples;
}

}  // namespace d2b
