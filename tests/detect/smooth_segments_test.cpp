#include <cmath>

#include <gtest/gtest.h>

#include "detect/smoothness.hpp"
#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

using test::drawing;
using test::drawn;

/// Pieces of a level surface with the flags given, or the same flags everywhere.
SmoothSegments pieces_of(const Mask& elevated, const Grid<std::uint8_t>& flags, const CellSize& cell) {
    const MetreGrid level(elevated.rows, elevated.cols, 8);
    const MetreGrid ground(elevated.rows, elevated.cols, 0);
    return smooth_segments({level, ground, cell}, elevated, flags, test::threads());
}
SmoothSegments pieces_of(const Mask& elevated, std::uint8_t flag, const CellSize& cell) {
    return pieces_of(elevated, Grid<std::uint8_t>(elevated.rows, elevated.cols, flag), cell);
}

TEST(Segments, TiltIsThatOfThePlane) {
    const CellSize cell{0.5, 0.8};
    for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {0.25, 0.0}, {0.0, -0.5}, {0.3, 0.4}}) {
        test::Town town(20, 30, cell);
        town.build([&, x = dx, y = dy](auto r, auto c) {
            return r >= 5 && r < 15 && c >= 8 && c < 24
                       ? static_cast<float>(120 + x * c * cell.across + y * r * cell.down)
                       : test::unknown;
        });
        const SmoothSegments segments = smooth_segments(
            town.scene(), test::raised(town),
            smoothness(town.surface, smoothness_thresholds(town.scene().side(), {}), test::threads()),
            test::threads());
        ASSERT_EQ(segments.pieces.size(), 1U);
        EXPECT_EQ(segments.pieces[0].cells, 160);
        EXPECT_EQ(drawing(mask_of(segments.regions, test::threads())), drawing(test::raised(town)));
        EXPECT_NEAR(segments.pieces[0].tilt, std::hypot(dx, dy), 1e-5);
    }
}

TEST(Segments, GableIsOnePieceSinceItsRidgeIsStraight) {
    test::Town town(20, 20);
    town.build([](auto r, auto c) {
        return r >= 3 && r < 17 && c >= 3 && c < 17 ? 112 - 0.5F * std::abs(static_cast<float>(c) - 9.5F)
                                                    : test::unknown;
    });
    const SmoothSegments segments = smooth_segments(
        town.scene(), test::raised(town),
        smoothness(town.surface, smoothness_thresholds(1, {}), test::threads()), test::threads());
    ASSERT_EQ(segments.pieces.size(), 1U);
    EXPECT_EQ(segments.pieces[0].cells, 196);
    EXPECT_NEAR(segments.pieces[0].tilt, 0, 1e-6) << "the best plane through both sides";
}

TEST(Segments, JoinedWhereOneIsStraightAlongOrBothAreSomeWay) {
    // Two blocks of 3 by 4 cells; what joins them are the flags at their common edge.
    const Mask across(3, 8, 1);
    const auto count = [&](bool beside, std::uint8_t left, std::uint8_t right) {
        Grid<std::uint8_t> flags(3, 8, smooth_along_row | smooth_along_column);
        for (std::int32_t r = 0; r < 3; ++r) {
            flags.at(r, 3) = left;
            flags.at(r, 4) = right;
        }
        // Within its column each of the two hangs on its neighbour outside, whatever its own flags.
        return (beside ? pieces_of(across, flags, {1, 1})
                       : pieces_of(test::transposed(across), test::transposed(flags), {1, 1}))
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
    EXPECT_EQ(drawing(mask_of(fine.regions, test::threads())),
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
}  // namespace d2b
