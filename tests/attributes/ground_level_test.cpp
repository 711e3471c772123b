#include "attributes/ground_level.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace d2b {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// 7 x 7 cells with a label of 5 x 5. Its terrain is 100; that of the 20 cells beside it counts from 1 on,
/// and the corners, which touch it in a point alone, lie at -100.
struct Scene {
    MetreGrid terrain{7, 7, 100};
    Grid<Label> labels{7, 7, 1};

    Scene() {
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
    const Scene scene;
    // Both sides of 20 edges: 1 to 20, and 100 twenty times. A tenth of 40 values lies below the fifth.
    const std::vector<double> ground = ground_levels(scene.terrain, scene.labels, 1);
    ASSERT_EQ(ground.size(), 2U);
    EXPECT_EQ(ground[1], 5);
}

TEST(GroundLevel, LeavesOutWhatIsNotKnown) {
    Scene scene;
    scene.terrain.at(0, 1) = nan;  // that of 1: of 39 values the fourth is 5
    EXPECT_EQ(ground_levels(scene.terrain, scene.labels, 1)[1], 5);
    scene.terrain = MetreGrid(7, 7, nan);
    EXPECT_TRUE(std::isnan(ground_levels(scene.terrain, scene.labels, 1)[1]));
}

TEST(GroundLevel, EachLabelHasItsOwn) {
    // 1 | 2 2 over a step of the terrain, side by side: a border between buildings is a border of both.
    MetreGrid terrain(1, 4);
    terrain.values = {4, 3, 8, 9};
    Grid<Label> labels(1, 4);
    labels.values = {0, 1, 2, 2};
    const std::vector<double> ground = ground_levels(terrain, labels, 3);
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
    EXPECT_EQ(ground_levels(terrain, labels, 1)[1], 3);  // of 1 to 20 the third
}

TEST(GroundLevel, OfNothingIsNothing) {
    EXPECT_EQ(ground_levels(MetreGrid(), Grid<Label>(), 0).size(), 1U);
}

}  // namespace
}  // namespace d2b
