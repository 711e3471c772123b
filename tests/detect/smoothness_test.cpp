#include "detect/smoothness.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

Grid<std::uint8_t> flags_of(const MetreGrid& surface, double side, double noise = 0) {
    return smoothness(surface, smoothness_thresholds(side, {.noise = noise}), test::threads());
}

using test::unknown;

constexpr int along_row = smooth_along_row;
constexpr int along_column = smooth_along_column;
constexpr int any = smooth_any_way;
constexpr int enough = smooth_enough;
constexpr int all = along_row | along_column | any | enough;

MetreGrid surface_of(std::int32_t rows, std::int32_t cols, const test::Shape& z) {
    MetreGrid grid(rows, cols);
    for (std::int32_t r = 0; r < rows; ++r)
        for (std::int32_t c = 0; c < cols; ++c)
            grid.at(r, c) = z(r, c);
    return grid;
}

TEST(Smoothness, PlanesAreSmoothInsideAndBendAtTheBorder) {
    const auto flags = flags_of(
        surface_of(
            6, 40,
            [](auto r, auto c) { return 0.25F * static_cast<float>(r) + 0.75F * static_cast<float>(c); }),
        1);
    for (std::int32_t r = 1; r < 5; ++r)
        for (std::int32_t c = 1; c < 39; ++c)
            EXPECT_EQ(flags.at(r, c), all) << r << ' ' << c;
    // The border continues outwards, so that a slope ends there: 0.75 m along the row, 0.25 m along the
    // column.
    EXPECT_EQ(flags.at(2, 0), along_column | any | enough);
    EXPECT_EQ(flags.at(2, 39), along_column | any | enough);
    EXPECT_EQ(flags.at(0, 2), along_row | any | enough);
    EXPECT_EQ(flags.at(5, 2), along_row | any | enough);
    EXPECT_EQ(flags.at(0, 0), 0);
}

TEST(Smoothness, StepBendsAcrossAlone) {
    const auto flags = flags_of(surface_of(5, 10, [](auto, auto c) { return c < 5 ? 0.0F : 3.0F; }), 1);
    for (std::int32_t c = 0; c < 10; ++c)
        EXPECT_EQ(flags.at(2, c), c == 4 || c == 5 ? along_column | any | enough : all) << c;
}

TEST(Smoothness, RidgesAreSmoothAlong) {
    const auto ridge = flags_of(
        surface_of(11, 11, [](auto, auto c) { return -0.5F * static_cast<float>(std::abs(c - 5)); }), 1);
    EXPECT_EQ(ridge.at(5, 5), along_column | any | enough);
    EXPECT_EQ(ridge.at(5, 4), all);
    for (const int sign : {1, -1}) {
        const auto diagonal = flags_of(surface_of(11, 11,
                                                  [&](auto r, auto c) {
                                                      const int across = sign * (c - 5) - (r - 5);
                                                      return -0.5F * static_cast<float>(std::abs(across));
                                                  }),
                                       1);
        EXPECT_EQ(diagonal.at(5, 5), any) << sign;
    }
}

TEST(Smoothness, ThresholdsGrowWithNoise) {
    const auto bump = [](float h, double noise) {
        return int{
            flags_of(surface_of(5, 5, [&](auto r, auto c) { return r == 2 && c == 2 ? h : 0.0F; }), 1, noise)
                .at(2, 2)};
    };
    // 7 cm are in the thresholds; 17 cm add 15 cm to the 0.12, 0.18 and 0.25 m of cells of 1 m.
    EXPECT_EQ(bump(0.061F, 0.07), any | enough);
    EXPECT_EQ(bump(0.134F, 0.17), all);
    EXPECT_EQ(bump(0.136F, 0.17), any | enough);
    EXPECT_EQ(bump(0.199F, 0.17), any | enough);
    EXPECT_EQ(bump(0.201F, 0.17), any);
    EXPECT_EQ(bump(0.246F, 0.17), any);
    EXPECT_EQ(bump(0.249F, 0.17), 0);
}

TEST(Smoothness, ThresholdsGrowWhereCellsWereFilled) {
    const auto limits = [](double side, double filled) {
        return smoothness_thresholds(side, {.filled = filled});
    };
    // At 2 m: 0.18, 0.26 and 0.37 m. 0.17 x 2 m x sqrt(0.27 - 0.02) = 0.17 m more.
    EXPECT_NEAR(limits(2, 0.27).line, 0.35, 1e-6);
    EXPECT_NEAR(limits(2, 0.27).any, 0.43, 1e-6);
    EXPECT_NEAR(limits(2, 0.27).enough, 0.54, 1e-6);
    EXPECT_EQ(limits(2, 0.02).line, limits(2, 0).line) << "some are filled in any survey";
    EXPECT_NEAR(smoothness_thresholds(2, {.filled = 0.27, .threshold_scale = 0.5, .margin_scale = 3}).line,
                0.09 + 3 * 0.17, 1e-6);
    // At 0.5 m: 0.09 m and 0.17 x 0.5 m x 0.5.
    EXPECT_NEAR(limits(0.5, 0.27).line, 0.1325, 1e-6);
}

TEST(Smoothness, StricterLimitsKeepTheirRoomForNoise) {
    // At 1 m: 0.12, 0.18 and 0.25 m. 17 cm of noise add 15 cm.
    const SmoothnessThresholds limits = smoothness_thresholds(1, {.noise = 0.17, .threshold_scale = 0.5});
    EXPECT_NEAR(limits.line, 0.06 + 0.15, 1e-6);
    EXPECT_NEAR(limits.any, 0.09 + 0.15, 1e-6);
    EXPECT_NEAR(limits.enough, 0.125 + 0.15, 1e-6);
}

TEST(Smoothness, ThresholdsGrowWithTheCell) {
    // A bump of h bends by 2 h every way; 2/3 of that counts along diagonals.
    const auto bump = [](float h, double side) {
        return int{
            flags_of(surface_of(5, 5, [&](auto r, auto c) { return r == 2 && c == 2 ? h : 0.0F; }), side)
                .at(2, 2)};
    };
    // At 1 m: 0.12 m along a line, 0.18 m any way, 0.25 m for enough.
    EXPECT_EQ(bump(0.059F, 1), all);
    EXPECT_EQ(bump(0.061F, 1), any | enough);
    EXPECT_EQ(bump(0.124F, 1), any | enough);
    EXPECT_EQ(bump(0.126F, 1), any);
    EXPECT_EQ(bump(0.134F, 1), any);
    EXPECT_EQ(bump(0.136F, 1), 0);
    // At 0.5 m: 0.09, 0.14 and 0.19 m.
    EXPECT_EQ(bump(0.044F, 0.5), all);
    EXPECT_EQ(bump(0.046F, 0.5), any | enough);
    EXPECT_EQ(bump(0.094F, 0.5), any | enough);
    EXPECT_EQ(bump(0.096F, 0.5), any);
    EXPECT_EQ(bump(0.104F, 0.5), any);
    EXPECT_EQ(bump(0.106F, 0.5), 0);
}

TEST(Smoothness, UnknownCellsBendWhateverMeetsThem) {
    const auto flags =
        flags_of(surface_of(7, 7, [](auto r, auto c) { return r == 3 && c == 3 ? unknown : 1.0F; }), 1);
    EXPECT_EQ(flags.at(3, 3), 0);
    for (const std::int32_t beside : {2, 4}) {
        EXPECT_EQ(flags.at(3, beside), along_column | any | enough);
        EXPECT_EQ(flags.at(beside, 3), along_row | any | enough);
        EXPECT_EQ(flags.at(beside, beside), all);
    }
}

TEST(Smoothness, OneCellOneRowOneColumnNone) {
    EXPECT_EQ(flags_of(MetreGrid(1, 1, 7.0F), 1).values, std::vector<std::uint8_t>{all});
    EXPECT_EQ(flags_of(MetreGrid(1, 1, unknown), 1).values, std::vector<std::uint8_t>{0});
    const MetreGrid step = surface_of(1, 5, [](auto, auto c) { return c < 2 ? 0.0F : 2.0F; });
    const std::vector<std::uint8_t> across{all, along_column | any | enough, along_column | any | enough, all,
                                           all};
    EXPECT_EQ(flags_of(step, 1).values, across);
    const std::vector<std::uint8_t> down{all, along_row | any | enough, along_row | any | enough, all, all};
    EXPECT_EQ(flags_of(test::transposed(step), 1).values, down);
    EXPECT_EQ(flags_of(MetreGrid(), 1).size(), 0U);
}

}  // namespace
}  // namespace d2b
