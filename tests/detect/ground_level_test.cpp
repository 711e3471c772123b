#include "detect/ground_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// 7 x 7 cells with a label of 5 x 5. Its terrain is 100; that of the 20 cells beside it counts from 1 on,
/// and the corners, which touch it in a point alone, lie at -100.
struct LabelledTerrain {
    MetreGrid terrain{7, 7, 100};
    Grid<Label> labels{7, 7, 1};

    LabelledTerrain() {
        float next = 1;
        for (std::int32_t r = 0; r < 7; ++r)
            for (std::int32_t c = 0; c < 7; ++c) {
                const bool row_edge = r == 0 || r == 6;
                const bool col_edge = c == 0 || c == 6;
                if (row_edge || col_edge) {
                    labels.at(r, c) = 0;
                    terrain.at(r, c) = row_edge && col_edge ? -100 : next++;
                }
            }
    }
};

TEST(GroundLevel, IsTheTenthPercentileAlongTheBorder) {
    const LabelledTerrain scene;
    // Both sides of 20 edges: 1 to 20, and 100 twenty times. A tenth of 40 values lies below the fifth.
    const std::vector<double> ground = ground_levels(scene.terrain, scene.labels, 1, threads());
    ASSERT_EQ(ground.size(), 2U);
    EXPECT_EQ(ground[1], 5);
}

TEST(GroundLevel, LeavesOutWhatIsNotKnown) {
    LabelledTerrain scene;
    scene.terrain.at(0, 1) = nan;  // that of 1: of 39 values the fourth is 5
    EXPECT_EQ(ground_levels(scene.terrain, scene.labels, 1, threads())[1], 5);
    scene.terrain = MetreGrid(7, 7, nan);
    EXPECT_TRUE(std::isnan(ground_levels(scene.terrain, scene.labels, 1, threads())[1]));
}

TEST(GroundLevel, EachLabelHasItsOwn) {
    // 1 | 2 2 over a step of the terrain, side by side: a border between buildings is a border of both.
    MetreGrid terrain(1, 4);
    terrain.values = {4, 3, 8, 9};
    Grid<Label> labels(1, 4);
    labels.values = {0, 1, 2, 2};
    const std::vector<double> ground = ground_levels(terrain, labels, 3, threads());
    EXPECT_EQ(ground[1], 3);
    EXPECT_EQ(ground[2], 3);                // its neighbour's foot is beside it
    EXPECT_TRUE(std::isnan(ground[3]));     // no such cell
    EXPECT_TRUE(std::isnan(ground.at(0)));  // nothing stands there
}

TEST(GroundLevel, OfWhatFillsTheRasterCountsAllOfIt) {
    MetreGrid terrain(2, 10);
    for (std::size_t i = 0; i < 20; ++i)
        terrain.values[i] = 20 - static_cast<float>(i);
    const Grid<Label> labels(2, 10, 1);
    EXPECT_EQ(ground_levels(terrain, labels, 1, threads())[1], 3);  // of 1 to 20 the third
}

TEST(GroundLevel, BandsAndThreadsDoNotShow) {
    constexpr std::int32_t rows = 70, cols = 20000;  // bands of sixteen rows
    std::mt19937 random(8);
    MetreGrid terrain(rows, cols);
    Grid<Label> labels(rows, cols);
    for (std::int32_t i = 0; i < rows; ++i)
        for (std::int32_t j = 0; j < cols; ++j) {
            terrain.at(i, j) = random() % 20 == 0 ? nan : static_cast<float>(random() % 1000);
            labels.at(i, j) = random() % 9 == 0 ? 0 : static_cast<Label>(1 + (i / 23) * 40 + j / 510);
        }
    std::vector<std::vector<float>> beside(200);
    const auto look = [&](std::int32_t i, std::int32_t j, std::int32_t y, std::int32_t x) {
        if (!labels.holds(y, x) || labels.at(i, j) == labels.at(y, x))
            return;
        for (const float z : {terrain.at(i, j), terrain.at(y, x)})
            if (!std::isnan(z))
                beside[labels.at(i, j)].push_back(z);  // each edge is seen from both of its sides
    };
    for (std::int32_t i = 0; i < rows; ++i)
        for (std::int32_t j = 0; j < cols; ++j) {
            look(i, j, i - 1, j);
            look(i, j, i + 1, j);
            look(i, j, i, j - 1);
            look(i, j, i, j + 1);
        }
    for (const int count : {1, 2, 5}) {
        Executor threads(count);
        const std::vector<double> ground = ground_levels(terrain, labels, 160, threads);
        for (Label label = 1; label <= 160; ++label) {
            std::vector<float> sorted = beside[label];
            std::sort(sorted.begin(), sorted.end());
            ASSERT_EQ(ground[label], static_cast<double>(sorted[sorted.size() / 10])) << label;
        }
    }
}

TEST(GroundLevel, OfNothingIsNothing) {
    EXPECT_EQ(ground_levels(MetreGrid(), Grid<Label>(), 0, threads()).size(), 1U);
}

}  // namespace
}  // namespace d2b::detect
