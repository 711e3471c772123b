#include "detect/smoothness.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

Grid<std::uint8_t> flags_of(const MetreGrid& surface, double side, double noise = 0) {
    return smoothness(surface, smoothness_thresholds(side, {.noise = noise}), threads());
}

constexpr int along_row = smooth_along_row;
constexpr int along_column = smooth_along_column;
constexpr int any = smooth_any_way;
constexpr int enough = smooth_enough;
constexpr int every_flag = along_row | along_column | any | enough;

MetreGrid surface_of(std::int32_t rows, std::int32_t cols, const Shape& z) {
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
            EXPECT_EQ(flags.at(r, c), every_flag) << r << ' ' << c;
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
        EXPECT_EQ(flags.at(2, c), c == 4 || c == 5 ? along_column | any | enough : every_flag) << c;
}

TEST(Smoothness, RidgesAreSmoothAlong) {
    const auto ridge = flags_of(
        surface_of(11, 11, [](auto, auto c) { return -0.5F * static_cast<float>(std::abs(c - 5)); }), 1);
    EXPECT_EQ(ridge.at(5, 5), along_column | any | enough);
    EXPECT_EQ(ridge.at(5, 4), every_flag);
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

TEST(Smoothness, BumpsAreSmoothUpToTheThresholds) {
    // A bump of h bends by 2 h every way, and 2/3 of that counts along diagonals.
    for (const double side : {0.5, 1.0, 2.5})
        for (const double noise : {0.0, 0.17}) {
            const SmoothnessThresholds limits = smoothness_thresholds(side, {.noise = noise});
            for (float h = 0.01F; h < 0.5F; h += 0.003F) {
                const auto bump = [&](auto r, auto c) { return r == 2 && c == 2 ? h : 0.0F; };
                const int expected = (2 * h <= limits.line ? along_row | along_column : 0) |
                                     (4 * h / 3 <= limits.any ? any : 0) |
                                     (2 * h <= limits.enough ? enough : 0);
                EXPECT_EQ(flags_of(surface_of(5, 5, bump), side, noise).at(2, 2), expected) << h;
            }
        }
}

TEST(Smoothness, ThresholdsGrowWithCellsNoiseAndFilledCells) {
    const auto grows = [](const SmoothnessThresholds& less, const SmoothnessThresholds& more) {
        return less.line < more.line && less.any < more.any && less.enough < more.enough;
    };
    const auto limits = [](double side, const SurfaceQuality& quality) {
        return smoothness_thresholds(side, quality);
    };
    EXPECT_TRUE(grows(limits(0.5, {}), limits(1, {})));
    EXPECT_TRUE(grows(limits(1, {}), limits(1, {.noise = 0.17})));
    EXPECT_TRUE(grows(limits(1, {}), limits(1, {.filled = 0.27})));
    EXPECT_TRUE(grows(limits(1, {.threshold_scale = 0.5}), limits(1, {})));
    EXPECT_TRUE(grows(limits(1, {.filled = 0.27}), limits(1, {.filled = 0.27, .margin_scale = 3})));
    EXPECT_EQ(limits(1, {.noise = 0.07}).line, limits(1, {}).line) << "the thresholds have room for it";
    EXPECT_EQ(limits(2, {.filled = 0.02}).line, limits(2, {}).line) << "some are filled in any survey";
}

TEST(Smoothness, UnknownCellsBendWhateverMeetsThem) {
    const auto flags =
        flags_of(surface_of(7, 7, [](auto r, auto c) { return r == 3 && c == 3 ? unknown : 1.0F; }), 1);
    EXPECT_EQ(flags.at(3, 3), 0);
    for (const std::int32_t beside : {2, 4}) {
        EXPECT_EQ(flags.at(3, beside), along_column | any | enough);
        EXPECT_EQ(flags.at(beside, 3), along_row | any | enough);
        EXPECT_EQ(flags.at(beside, beside), every_flag);
    }
}

TEST(Smoothness, OneCellOneRowOneColumnNone) {
    EXPECT_EQ(flags_of(MetreGrid(1, 1, 7.0F), 1).values, std::vector<std::uint8_t>{every_flag});
    EXPECT_EQ(flags_of(MetreGrid(1, 1, unknown), 1).values, std::vector<std::uint8_t>{0});
    const MetreGrid step = surface_of(1, 5, [](auto, auto c) { return c < 2 ? 0.0F : 2.0F; });
    const std::vector<std::uint8_t> across{every_flag, along_column | any | enough,
                                           along_column | any | enough, every_flag, every_flag};
    EXPECT_EQ(flags_of(step, 1).values, across);
    const std::vector<std::uint8_t> down{every_flag, along_row | any | enough, along_row | any | enough,
                                         every_flag, every_flag};
    EXPECT_EQ(flags_of(transposed(step), 1).values, down);
    EXPECT_EQ(flags_of(MetreGrid(), 1).size(), 0U);
}

/// Pieces of a level surface with the flags given, or the same flags everywhere.
SmoothSegments pieces_of(const Mask& elevated, const Grid<std::uint8_t>& flags, const CellSize& cell) {
    const MetreGrid level(elevated.rows, elevated.cols, 8);
    const MetreGrid ground(elevated.rows, elevated.cols, 0);
    return smooth_segments({level, ground, cell}, elevated, flags, threads());
}
SmoothSegments pieces_of(const Mask& elevated, std::uint8_t flag, const CellSize& cell) {
    return pieces_of(elevated, Grid<std::uint8_t>(elevated.rows, elevated.cols, flag), cell);
}

TEST(Segments, TiltIsThatOfThePlane) {
    const CellSize cell{0.5, 0.8};
    for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {0.25, 0.0}, {0.0, -0.5}, {0.3, 0.4}}) {
        Town town(20, 30, cell);
        town.build([&, x = dx, y = dy](auto r, auto c) {
            return r >= 5 && r < 15 && c >= 8 && c < 24
                       ? static_cast<float>(120 + x * c * cell.across + y * r * cell.down)
                       : unknown;
        });
        const SmoothSegments segments = smooth_segments(
            town.scene(), raised(town),
            smoothness(town.surface, smoothness_thresholds(town.scene().side(), {}), threads()), threads());
        ASSERT_EQ(segments.pieces.size(), 1U);
        EXPECT_EQ(segments.pieces[0].cells, 160);
        EXPECT_EQ(drawing(mask_of(segments.regions, threads())), drawing(raised(town)));
        EXPECT_NEAR(segments.pieces[0].tilt, std::hypot(dx, dy), 1e-5);
    }
}

TEST(Segments, GableIsOnePieceSinceItsRidgeIsStraight) {
    Town town(20, 20);
    town.build([](auto r, auto c) {
        return r >= 3 && r < 17 && c >= 3 && c < 17 ? 112 - 0.5F * std::abs(static_cast<float>(c) - 9.5F)
                                                    : unknown;
    });
    const SmoothSegments segments =
        smooth_segments(town.scene(), raised(town),
                        smoothness(town.surface, smoothness_thresholds(1, {}), threads()), threads());
    ASSERT_EQ(segments.pieces.size(), 1U);
    EXPECT_EQ(segments.pieces[0].cells, 196);
    EXPECT_NEAR(segments.pieces[0].tilt, 0, 1e-6) << "the best plane through both sides";
}

TEST(Segments, JoinedWhereOneIsStraightAlongOrBothAreSomeWay) {
    // Two blocks of 3 by 4 cells, joined by the flags at their common edge.
    const Mask across(3, 8, 1);
    const auto count = [&](bool beside, std::uint8_t left, std::uint8_t right) {
        Grid<std::uint8_t> flags(3, 8, smooth_along_row | smooth_along_column);
        for (std::int32_t r = 0; r < 3; ++r) {
            flags.at(r, 3) = left;
            flags.at(r, 4) = right;
        }
        // Within its column each of the two hangs on its neighbour outside, whatever its own flags.
        return (beside ? pieces_of(across, flags, {1, 1})
                       : pieces_of(transposed(across), transposed(flags), {1, 1}))
            .pieces.size();
    };
    for (const bool beside : {true, false}) {
        const std::uint8_t line = beside ? smooth_along_row : smooth_along_column;
        const std::uint8_t other = beside ? smooth_along_column : smooth_along_row;
        EXPECT_EQ(count(beside, 0, 0), 2U);
        EXPECT_EQ(count(beside, line, 0), 1U);
        EXPECT_EQ(count(beside, 0, line), 1U);
        EXPECT_EQ(count(beside, other, other), 2U);
        EXPECT_EQ(count(beside, smooth_any_way, other), 2U);
        EXPECT_EQ(count(beside, smooth_any_way, smooth_any_way), 1U);
        EXPECT_EQ(count(beside, smooth_enough, smooth_enough), 2U);
    }
}

TEST(Segments, SmallPiecesAreDropped) {
    constexpr std::uint8_t smooth = smooth_along_row | smooth_along_column;
    // 12 m²: eleven cells of 1 m² are too few, twelve are not.
    const Mask blocks = drawn({"###########.", "............", "############"});
    const SmoothSegments fine = pieces_of(blocks, smooth, {1, 1});
    ASSERT_EQ(fine.pieces.size(), 1U);
    EXPECT_EQ(drawing(mask_of(fine.regions, threads())),
              drawing(drawn({"............", "............", "############"})));
    // Six cells at least, however large they are.
    const SmoothSegments coarse = pieces_of(drawn({"#####.", "......", "######"}), smooth, {10, 10});
    ASSERT_EQ(coarse.pieces.size(), 1U);
    EXPECT_EQ(coarse.pieces[0].cells, 6);
    EXPECT_NEAR(coarse.pieces[0].tilt, 0, 1e-12) << "in one line";
    EXPECT_TRUE(pieces_of(Mask(4, 4), smooth, {1, 1}).pieces.empty());
    EXPECT_TRUE(pieces_of(Mask(), smooth, {1, 1}).pieces.empty());
}

}  // namespace
}  // namespace d2b::detect
