#include "diagnose/ground_fit.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace d2b {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

TEST(GroundFit, CountsWhatIsKnownOfBoth) {
    GroundFit fit(2);
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
    GroundFit one(2);
    GroundFit other(2);
    GroundFit both(2);
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
    GroundFit all(2);
    all.add(surface, ground);
    GroundFit each(2);
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
    GroundFit fit(2);
    fit.add(std::vector<float>{3e38F, 3e38F, -3e38F, std::numeric_limits<float>::infinity()},
            std::vector<float>{0, -3e38F, 0, 0});
    EXPECT_EQ(fit.cells(), 4);
    EXPECT_NEAR(fit.median(), 500, 1);
    EXPECT_NEAR(fit.bare_median(), -500, 1);
}

}  // namespace
}  // namespace d2b
