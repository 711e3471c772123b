#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "detect/object_features.hpp"
#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

double compactness_of(const Mask& object) {
    ShapeMoments sums;
    const Regions regions = connected_regions(object, 1, 0, test::threads());
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r))
            sums.add(r, run);
    return sums.compactness();
}

TEST(ShapeMoments, RectanglesAreAllAlike) {
    // The variance of a side is its square by twelve, so the ellipse has pi / 3 times the area.
    for (const Mask& object : {Mask(1, 1, 1), Mask(3, 3, 1), Mask(2, 40, 1), Mask(25, 1, 1)})
        EXPECT_NEAR(compactness_of(object), 3 / std::numbers::pi, 1e-9) << object.rows << " " << object.cols;
}

TEST(ShapeMoments, OfAnAngleOfThreeCells) {
    // Variances are 2 / 9 and a cell's own 1 / 12, the covariance is 1 / 9.
    const double spread = std::pow(11.0 / 36, 2) - 1.0 / 81;
    const double expected = 3 / (4 * std::numbers::pi * std::sqrt(spread));
    EXPECT_NEAR(compactness_of(test::drawn({"#.", "##"})), expected, 1e-12);
    EXPECT_NEAR(compactness_of(test::drawn({"....", "..##", "...#"})), expected, 1e-12);
    EXPECT_NEAR(compactness_of(test::drawn({".#", "##"})), expected, 1e-12) << "what lies left of the first";
}

TEST(ShapeMoments, ADiskIsAnEllipse) {
    Mask disk(41, 41);
    for (std::int32_t r = 0; r < 41; ++r)
        for (std::int32_t c = 0; c < 41; ++c)
            disk.at(r, c) = std::hypot(r - 20, c - 20) < 20 ? 1 : 0;
    EXPECT_NEAR(compactness_of(disk), 1, 0.005);
}

TEST(ShapeMoments, ArmsMakeItLess) {
    EXPECT_LT(compactness_of(test::drawn({"#####", "#....", "#....", "#...."})), 0.7);
    EXPECT_EQ(ShapeMoments().compactness(), 1);
}

}  // namespace
}  // namespace d2b
