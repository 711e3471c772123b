#include <limits>

#include <gtest/gtest.h>

#include "diagnose/coverage.hpp"

namespace d2b {
namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// Elevations in boxes of 12 x 16 cells, so many in a row and a column, 20 cells apart.
MetreGrid boxes(int down, int across) {
    MetreGrid surface(20 * 6, 20 * 6, none);
    for (int r = 0; r < 20 * down; ++r)
        for (int c = 0; c < 20 * across; ++c)
            if (r % 20 < 12 && c % 20 < 16)
                surface.at(r, c) = 8;
    return surface;
}

ValidIslands islands_of(const MetreGrid& surface, double cell = 1) {
    Executor threads(2);
    ValidIslands islands;
    add_islands(surface, {cell, cell}, {0, 0, surface.rows, surface.cols}, 30, 60, islands, threads);
    return islands;
}

TEST(ValidIslands, AreHousesWithoutTheirGround) {
    const ValidIslands islands = islands_of(boxes(2, 3));
    EXPECT_EQ(islands.islands, 6);
    EXPECT_EQ(islands.cells, 6 * 12 * 16);
    EXPECT_EQ(islands.narrow, islands.cells);
    EXPECT_EQ(islands.largest, 12 * 16);
    EXPECT_EQ(
        missing_ground_warning(islands, GroundMode::automatic, "dem.tif"),
        "'dem.tif' has elevations in 6 pieces as wide as buildings and NoData around them, so roofs are "
        "taken for the ground; give -ground none where its values are heights above the ground, or a "
        "terrain model with -ground where they are elevations");
    EXPECT_EQ(missing_ground_warning(islands, GroundMode::none, "dem.tif"), "");
    EXPECT_EQ(missing_ground_warning(islands, GroundMode::given, "dem.tif"), "");
}

TEST(ValidIslands, AreNoneOfASurface) {
    MetreGrid surface(120, 120, 5);
    EXPECT_EQ(islands_of(surface).islands, 0);
    for (int r = 40; r < 120; ++r)
        for (int c = 30; c < 120; ++c)
            surface.at(r, c) = none;
    const ValidIslands wide = islands_of(surface);
    EXPECT_EQ(wide.islands, 0) << "an angle, as wide as it is long";
    EXPECT_EQ(missing_ground_warning(wide, GroundMode::automatic, "dem.tif"), "");
    EXPECT_EQ(missing_ground_warning(islands_of(boxes(1, 2)), GroundMode::automatic, "dem.tif"), "");
    EXPECT_EQ(islands_of(boxes(2, 3), 10).islands, 0) << "wider than buildings";
    EXPECT_EQ(islands_of(boxes(2, 3), 0.1).islands, 0) << "smaller than buildings";
}

TEST(ValidIslands, AddUp) {
    ValidIslands sum = islands_of(boxes(1, 2));
    sum.merge(islands_of(boxes(2, 3)));
    EXPECT_EQ(sum.islands, 8);
    EXPECT_EQ(sum.largest, 12 * 16);
}

}  // namespace
}  // namespace d2b
