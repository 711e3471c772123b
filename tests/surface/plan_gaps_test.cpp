#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "surface/planar_partition.hpp"

namespace d2b {
namespace {

/// The steps in a centimetre, rounded up: 10.24 of a metre, and so on; never fewer than two.
TEST(GapTolerances, followFromTheCell) {
    const auto pinch = [](double across, double down) { return gap_tolerances({across, down}).pinch; };
    EXPECT_EQ(pinch(1, 1), (LatticeDistance{11, 11}));
    EXPECT_EQ(pinch(0.5, 0.5), (LatticeDistance{21, 21}));
    EXPECT_EQ(pinch(0.25, 0.25), (LatticeDistance{41, 41}));
    EXPECT_EQ(pinch(0.1, 0.1), (LatticeDistance{103, 103}));
    EXPECT_EQ(pinch(2.5, 2.5), (LatticeDistance{5, 5}));
    EXPECT_EQ(pinch(30, 30), (LatticeDistance{2, 2}));
    EXPECT_EQ(pinch(0.5, 2), (LatticeDistance{6, 21})) << "rows are farther apart";
    EXPECT_EQ(pinch(0.3048, 0.3048), (LatticeDistance{34, 34})) << "feet";
}

/// 2 mm.
TEST(GapTolerances, ofCornersThatAreOne) {
    EXPECT_EQ(gap_tolerances({1, 1}).corners, (LatticeDistance{3, 3}));
    EXPECT_EQ(gap_tolerances({0.1, 0.1}).corners, (LatticeDistance{21, 21}));
    EXPECT_EQ(gap_tolerances({3, 3}).corners, (LatticeDistance{1, 1})) << "each step is as long";
}

/// Whatever the angle between rows and columns, what lies on the border of the box is as far away.
TEST(GapTolerances, areLengthsOnTheGround) {
    for (const double angle : {30.0, 90.0, 140.0})
        for (const double down : {0.1, 0.7, 5.0}) {
            const double across = 0.5;
            const double radians = angle * std::numbers::pi / 180;
            const LatticeDistance gap = gap_tolerances({across, down, std::sin(radians)}).pinch;
            double least = 1;
            for (std::int64_t row = -gap.rows; row <= gap.rows; ++row)
                for (std::int64_t col = -gap.cols; col <= gap.cols; ++col)
                    if (gap.parts({0, 0}, {row, col})) {
                        const double x = across * static_cast<double>(col);
                        const double y = down * static_cast<double>(row);
                        least = std::min(least, std::hypot(x + y * std::cos(radians), y * std::sin(radians)) /
                                                    FinePoint::steps);
                    }
            EXPECT_GE(least, 0.01) << angle << " " << down;
        }
}

}  // namespace
}  // namespace d2b
