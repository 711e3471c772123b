#include "raster/opening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "raster/rank_filter.hpp"
#include "support/random_surface.hpp"

namespace d2b {
namespace {

struct Offset {
    std::int32_t down;
    std::int32_t across;
};

/// By the definition: of all elements that hold a cell, the highest of their lowest values. Their centres
/// lie at most `outside` cells out of the grid.
MetreGrid opened_by_definition(const MetreGrid& grid, const std::vector<Offset>& window, Radius outside) {
    MetreGrid opened(grid.rows, grid.cols, -no_value);
    for (std::int32_t i = -outside.down; i < grid.rows + outside.down; ++i)
        for (std::int32_t j = -outside.across; j < grid.cols + outside.across; ++j) {
            float lowest = no_value;
            for (const Offset& o : window)
                if (grid.holds(i + o.down, j + o.across))
                    lowest = std::min(lowest, grid.at(i + o.down, j + o.across));
            for (const Offset& o : window)
                if (lowest != no_value && grid.holds(i + o.down, j + o.across))
                    opened.at(i + o.down, j + o.across) =
                        std::max(opened.at(i + o.down, j + o.across), lowest);
        }
    for (std::size_t k = 0; k < grid.size(); ++k)
        if (grid.values[k] == no_value)
            opened.values[k] = no_value;
    return opened;
}

std::vector<Offset> rectangle(Radius radius) {
    std::vector<Offset> window;
    for (std::int32_t i = -radius.down; i <= radius.down; ++i)
        for (std::int32_t j = -radius.across; j <= radius.across; ++j)
            window.push_back({i, j});
    return window;
}

std::vector<Offset> line(std::int32_t radius, std::int32_t down, std::int32_t across) {
    std::vector<Offset> window;
    for (std::int32_t k = -radius; k <= radius; ++k)
        window.push_back({k * down, k * across});
    return window;
}

TEST(Opening, ByARectangleIsTheDefinition) {
    Workspace<float> workspace;
    for (unsigned seed = 0; seed < 60; ++seed) {
        const MetreGrid grid = test::random_surface(seed, static_cast<std::int32_t>(1 + seed % 13),
                                                    static_cast<std::int32_t>(1 + seed % 17), 3);
        const Radius radius{static_cast<std::int32_t>(1 + seed % 4), static_cast<std::int32_t>(1 + seed % 3)};
        const Radius outside{static_cast<std::int32_t>(seed % 3), static_cast<std::int32_t>(seed % 2)};
        MetreGrid opened;
        open(ElementShape::rectangle, grid, radius, outside, workspace, opened);
        ASSERT_EQ(opened.values, opened_by_definition(grid, rectangle(radius), outside).values) << seed;
    }
}

TEST(Opening, ByLinesIsTheSecondHighestOfFour) {
    Workspace<float> workspace;
    for (unsigned seed = 0; seed < 60; ++seed) {
        const MetreGrid grid = test::random_surface(seed, static_cast<std::int32_t>(1 + seed % 15),
                                                    static_cast<std::int32_t>(1 + seed % 11), 5);
        const auto radius = static_cast<std::int32_t>(1 + seed % 5);
        const auto diagonal = std::max(1, static_cast<std::int32_t>(std::lround(0.7071 * radius)));
        const Radius outside{static_cast<std::int32_t>(seed % 2), static_cast<std::int32_t>(seed % 2)};
        const std::array<MetreGrid, 4> by_line{opened_by_definition(grid, line(radius, 0, 1), outside),
                                               opened_by_definition(grid, line(radius, 1, 0), outside),
                                               opened_by_definition(grid, line(diagonal, 1, 1), outside),
                                               opened_by_definition(grid, line(diagonal, 1, -1), outside)};
        MetreGrid opened;
        open(ElementShape::lines, grid, {radius, radius}, outside, workspace, opened);
        for (std::size_t k = 0; k < grid.size(); ++k) {
            std::array<float, 4> of{by_line[0].values[k], by_line[1].values[k], by_line[2].values[k],
                                    by_line[3].values[k]};
            std::sort(of.begin(), of.end());
            ASSERT_EQ(opened.values[k], of[2]) << seed << " " << k;
        }
    }
}

TEST(Opening, LinesKeepTheEdgeOfATerraceAndCutABlock) {
    MetreGrid terrace(21, 21, 0.0F), block = terrace;
    for (std::int32_t i = 0; i < 21; ++i)
        for (std::int32_t j = 0; j < 21; ++j) {
            terrace.at(i, j) = j >= 10 ? 5.0F : 0.0F;
            block.at(i, j) = i > 7 && i < 13 && j > 7 && j < 13 ? 5.0F : 0.0F;
        }
    Workspace<float> workspace;
    MetreGrid opened;
    open(ElementShape::lines, terrace, {8, 8}, {8, 8}, workspace, opened);
    EXPECT_EQ(opened.values, terrace.values);
    open(ElementShape::lines, block, {8, 8}, {0, 0}, workspace, opened);
    EXPECT_EQ(opened.values, MetreGrid(21, 21, 0.0F).values);
}

TEST(Closing, FillsWhatIsNarrowerThanItsWindow) {
    MetreGrid grid(9, 9, 4.0F);
    grid.at(4, 4) = 0;
    grid.at(0, 0) = no_value;
    Workspace<float> workspace;
    MetreGrid closed;
    close_rectangle(grid, {1, 1}, workspace, closed);
    EXPECT_EQ(closed.at(4, 4), 4);
    for (std::int32_t i = 2; i < 7; ++i)
        for (std::int32_t j = 2; j < 7; ++j)
            grid.at(i, j) = 0;
    close_rectangle(grid, {1, 1}, workspace, closed);
    EXPECT_EQ(closed.at(4, 4), 0);
}

TEST(Opening, ClosesWholeNumbersAsItClosesFloats) {
    Workspace<float> workspace;
    Workspace<std::int16_t> narrow;
    for (unsigned seed = 0; seed < 40; ++seed) {
        const MetreGrid grid = test::random_surface(seed, static_cast<std::int32_t>(1 + seed % 13),
                                                    static_cast<std::int32_t>(1 + seed % 19), 3);
        Grid<std::int16_t> whole(grid.rows, grid.cols);
        std::ranges::transform(grid.values, whole.values.begin(), [](float z) {
            return z == no_value ? no_value_of<std::int16_t>
                                 : static_cast<std::int16_t>(std::lround(100 * z));
        });
        MetreGrid hundredfold = grid;
        for (float& z : hundredfold.values)
            z = z == no_value ? no_value : std::round(100 * z);
        const Radius radius{static_cast<std::int32_t>(1 + seed % 4), static_cast<std::int32_t>(1 + seed % 3)};
        MetreGrid closed;
        Grid<std::int16_t> closed_whole;
        close_rectangle(hundredfold, radius, workspace, closed);
        close_rectangle(whole, radius, narrow, closed_whole);
        for (std::size_t k = 0; k < closed.size(); ++k) {
            const std::int16_t z = closed_whole.values[k];
            ASSERT_EQ(z == no_value_of<std::int16_t> ? no_value : static_cast<float>(z), closed.values[k]);
        }
    }
}

}  // namespace
}  // namespace d2b
