#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "score/objects.hpp"
#include "score/shapes.hpp"

namespace d2b::test {
namespace {

TEST(HeightErrors, ofThree) {
    const HeightErrors errors = height_errors(std::vector<double>{-1, 2, 5}).value();
    EXPECT_EQ(errors.pairs, 3U);
    EXPECT_DOUBLE_EQ(errors.mean, 2);
    EXPECT_DOUBLE_EQ(errors.rms, std::sqrt(10.0));
    EXPECT_EQ(errors.median_absolute, 2);
}

TEST(HeightErrors, takeTheMiddleOfTwoMedians) {
    EXPECT_EQ(height_errors(std::vector<double>{-4, 1, 2, 10}).value().median_absolute, 3);
}

TEST(HeightErrors, areNothingWithoutPairs) {
    EXPECT_FALSE(height_errors({}));
}

TEST(ObjectHeights, areMeansByArea) {
    Overlay overlay;
    const Polygons objects{box(0, 0, 10, 10), box(20, 0, 30, 10), box(40, 0, 50, 10)};
    // In the first object 30 m2 of 4 m, 70 m2 of 14 m, and one without a height; in the second none.
    const std::vector<Polygons> areas{
        {box(0, 0, 3, 10)}, {box(3, 0, 10, 10)}, {box(1, 1, 2, 2)}, {box(20, 0, 30, 10)}};
    const std::vector<std::optional<double>> heights{4.0, 14.0, {}, {}};
    const auto result = object_heights(heights, areas, objects, overlay);
    ASSERT_EQ(result.size(), 3U);
    EXPECT_DOUBLE_EQ(result[0].value(), 0.3 * 4 + 0.7 * 14);
    EXPECT_FALSE(result[1]);
    EXPECT_FALSE(result[2]);
}

}  // namespace
}  // namespace d2b::test
