#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "ground/ground.hpp"
#include "ground/progressive_opening.hpp"
#include "support/random_surface.hpp"
#include "support/test_threads.hpp"

namespace d2b::ground {
namespace {

/// Hills, houses and trees, pits, and points that are missing.
MetreGrid city(std::int32_t rows, std::int32_t cols) {
    std::mt19937 random(11);
    const auto below = [&](std::int32_t end) {
        return static_cast<std::int32_t>(random() % static_cast<unsigned>(end));
    };
    MetreGrid surface(rows, cols);
    for (std::int32_t i = 0; i < rows; ++i)
        for (std::int32_t j = 0; j < cols; ++j)
            surface.at(i, j) =
                200 + 9 * std::sin(static_cast<float>(i) / 90) * std::cos(static_cast<float>(j) / 70);
    for (int house = 0; house < rows * cols / 900; ++house) {
        const std::int32_t row = below(rows), col = below(cols), height = 3 + below(9);
        for (std::int32_t i = row; i < std::min(rows, row + 3 + height * 3); ++i)
            for (std::int32_t j = col; j < std::min(cols, col + 5 + house % 20); ++j)
                surface.at(i, j) += static_cast<float>(height);
    }
    for (float& z : surface.values) {
        z += static_cast<float>(below(100)) / 500;
        if (below(400) == 0)
            z += below(4) == 0 ? -30.0F : 6.0F;
        if (below(30) == 0)
            z = std::nanf("");
    }
    return surface;
}

/// The same bits, NaN included.
template <typename T>
bool same(const Grid<T>& a, const Grid<T>& b) {
    return a.rows == b.rows && a.cols == b.cols &&
           std::memcmp(a.values.data(), b.values.data(), a.size() * sizeof(T)) == 0;
}

TEST(GroundThreads, TheirNumberDoesNotShow) {
    const MetreGrid before = city(1500, 900);
    MetreGrid surface = before;
    for (const double size : {1.0, 0.4}) {
        Context one;
        const Terrain expected = estimate_ground(surface, {size, size * 1.2}, {}, one, {13, -7});
        for (const int threads : {2, 5}) {
            Context context;
            context.threads = std::make_unique<Executor>(threads);
            const Terrain terrain = estimate_ground(surface, {size, size * 1.2}, {}, context, {13, -7});
            EXPECT_TRUE(same(terrain.elevation, expected.elevation)) << threads;
            EXPECT_TRUE(same(terrain.flags, expected.flags)) << threads;
            EXPECT_TRUE(same(surface, before)) << threads;
        }
    }
}

constexpr OpeningParameters elements{2, 40, 0.5, 0.1, 1.4, 8};

/// All elements on the whole grid, one after the other.
MetreGrid limits_without_tiles(const MetreGrid& surface, const OpeningParameters& of, ElementShape element) {
    MetreGrid now = surface, next, limits(surface.rows, surface.cols, no_value);
    Workspace<float> workspace;
    for (const StructuringElement& step : element_series(of, {1, 1}).steps) {
        open(element, now, step.radius, step.outside, workspace, next);
        for (std::size_t k = 0; k < now.size(); ++k)
            if (now.values[k] > next.values[k] + step.rise)
                limits.values[k] = std::min(limits.values[k], next.values[k] + step.rise);
        std::swap(now, next);
    }
    return limits;
}

TEST(Tiles, CoverEachCellOnce) {
    for (const std::int32_t side : {1, 3, 64}) {
        Grid<int> seen(17, 40);
        for (const Tile& tile : tiles_of(17, 40, side)) {
            EXPECT_LE(std::max(tile.rows, tile.cols), side);
            for (std::int32_t i = tile.row; i < tile.row + tile.rows; ++i)
                for (std::int32_t j = tile.col; j < tile.col + tile.cols; ++j)
                    ++seen.at(i, j);
        }
        EXPECT_EQ(seen.values, Grid<int>(17, 40, 1).values);
    }
}

TEST(Tiles, DoNotShowInLimits) {
    AlignedGrid surface;
    surface.cell = {1, 1};
    OpeningParameters small = elements;
    small.last_radius = 28;  // no blocks of blocks
    // Tries steps of a metre, a centimetre, a millimetre, and none that is whole.
    for (const float step : {1.0F, 0.01F, 0.001F, 0.0123F}) {
        surface.grid = test::random_surface(5, 700, 1300, 9);
        for (float& z : surface.grid.values)
            z = z == no_value ? z : static_cast<float>(std::lround(z)) * step * 7;
        for (const ElementShape element : {ElementShape::rectangle, ElementShape::lines})
            EXPECT_EQ(limits_on_blocks(surface, small, element, test::threads()).values,
                      limits_without_tiles(surface.grid, small, element).values)
                << step;
    }
}

}  // namespace
}  // namespace d2b::ground
