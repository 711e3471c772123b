#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "detect/scene_statistics.hpp"
#include "diagnose/search_warnings.hpp"

namespace d2b::diagnose {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

TEST(GroundFit, CountsWhatIsKnownOfBoth) {
    detect::GroundFit fit(2);
    EXPECT_EQ(fit.cells(), 0);
    EXPECT_EQ(fit.bare_share(), 1);
    EXPECT_EQ(fit.share_above(2), 0);
    EXPECT_TRUE(std::isnan(fit.median()));
    // Heights: 0, 2, 2.5, 10, -3, and two that are not known.
    fit.add(std::vector<float>{100, 102, 102.5F, 110, 97, unknown, 5},
            std::vector<float>{100, 100, 100, 100, 100, 100, unknown});
    EXPECT_EQ(fit.cells(), 5);
    EXPECT_DOUBLE_EQ(fit.bare_share(), 3 / 5.0);
    EXPECT_DOUBLE_EQ(fit.share_above(2.25), 2 / 5.0);
    EXPECT_NEAR(fit.median(), 2, 0.126);
    EXPECT_NEAR(fit.bare_median(), 0, 0.126);
}

TEST(GroundFit, AddsUp) {
    detect::GroundFit one(2);
    detect::GroundFit other(2);
    detect::GroundFit both(2);
    const std::vector<float> ground(3, 0.0F);
    one.add(std::vector<float>{1, 2, 3}, ground);
    other.add(std::vector<float>{40, 41, 42}, ground);
    both.add(std::vector<float>{40, 1, 41}, ground);
    both.add(std::vector<float>{2, 3, 42}, ground);
    one.merge(other);
    EXPECT_EQ(one.cells(), both.cells());
    EXPECT_EQ(one.median(), both.median());
    EXPECT_EQ(one.bare_median(), both.bare_median());
    EXPECT_EQ(one.bare_share(), both.bare_share());
}

TEST(GroundFit, CountsManyCellsAsEachOne) {
    // Heights of 0 to 9.99 m in steps of a centimetre, each tenth of them not known.
    std::vector<float> surface;
    for (int i = 0; i < 1000; ++i)
        surface.push_back(i % 10 == 3 ? unknown : 0.01F * static_cast<float>(i));
    const std::vector<float> ground(surface.size(), 0.0F);
    detect::GroundFit all(2);
    all.add(surface, ground);
    detect::GroundFit each(2);
    for (const float& z : surface)
        each.add(std::span(&z, 1), std::span(ground).first(1));
    EXPECT_EQ(all.cells(), 900);
    EXPECT_DOUBLE_EQ(all.share_above(5), 450 / 900.0);
    EXPECT_EQ(all.bare_share(), each.bare_share());
    EXPECT_EQ(all.median(), each.median());
    EXPECT_EQ(all.bare_median(), each.bare_median());
    for (const double height : {-1.0, 0.0, 0.3, 2.0, 7.75, 9.9})
        EXPECT_EQ(all.share_above(height), each.share_above(height)) << height;
}

TEST(GroundFit, BearsAnyHeight) {
    detect::GroundFit fit(2);
    fit.add(std::vector<float>{3e38F, 3e38F, -3e38F, std::numeric_limits<float>::infinity()},
            std::vector<float>{0, -3e38F, 0, 0});
    EXPECT_EQ(fit.cells(), 4);
    EXPECT_NEAR(fit.median(), 500, 1);
    EXPECT_NEAR(fit.bare_median(), -500, 1);
}

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

detect::ValidIslands islands_of(const MetreGrid& surface, double cell = 1) {
    Executor threads(2);
    detect::ValidIslands islands;
    detect::add_islands(surface, {cell, cell}, {0, 0, surface.rows, surface.cols}, 30, 60, islands, threads);
    return islands;
}

TEST(ValidIslands, AreHousesWithoutTheirGround) {
    const detect::ValidIslands islands = islands_of(boxes(2, 3));
    EXPECT_EQ(islands.islands, 6);
    EXPECT_EQ(islands.cells, 6 * 12 * 16);
    EXPECT_EQ(islands.narrow, islands.cells);
    EXPECT_EQ(islands.largest, 12 * 16);
    EXPECT_EQ(missing_ground_warning(islands, GroundMode::automatic, "dem.tif"),
              "'dem.tif' has elevations in 6 pieces as wide as buildings and NoData around them, so roofs "
              "are taken for the ground; give -ground none if its values are heights above ground, or a "
              "terrain model with -ground if they are elevations");
    EXPECT_EQ(missing_ground_warning(islands, GroundMode::none, "dem.tif"), "");
    EXPECT_EQ(missing_ground_warning(islands, GroundMode::given, "dem.tif"), "");
}

TEST(ValidIslands, AreNoneOfASurface) {
    MetreGrid surface(120, 120, 5);
    EXPECT_EQ(islands_of(surface).islands, 0);
    for (int r = 40; r < 120; ++r)
        for (int c = 30; c < 120; ++c)
            surface.at(r, c) = none;
    const detect::ValidIslands wide = islands_of(surface);
    EXPECT_EQ(wide.islands, 0) << "an angle, as wide as it is long";
    EXPECT_EQ(missing_ground_warning(wide, GroundMode::automatic, "dem.tif"), "");
    EXPECT_EQ(missing_ground_warning(islands_of(boxes(1, 2)), GroundMode::automatic, "dem.tif"), "");
    EXPECT_EQ(islands_of(boxes(2, 3), 10).islands, 0) << "wider than buildings";
    EXPECT_EQ(islands_of(boxes(2, 3), 0.1).islands, 0) << "smaller than buildings";
}

TEST(ValidIslands, AddUp) {
    detect::ValidIslands sum = islands_of(boxes(1, 2));
    sum.merge(islands_of(boxes(2, 3)));
    EXPECT_EQ(sum.islands, 8);
    EXPECT_EQ(sum.largest, 12 * 16);
}

}  // namespace
}  // namespace d2b::diagnose
