#include <cmath>

#include <gtest/gtest.h>

#include "detect/object_features.hpp"
#include "detect_case.hpp"

namespace d2b {
namespace {

BorderSums sums_of(const test::Town& town, const Mask& objects) {
    BorderSums sums;
    for (std::int32_t r = 0; r < objects.rows; ++r)
        for (std::int32_t c = 0; c < objects.cols; ++c)
            if (objects.at(r, c) != 0)
                sums.add(town.scene(), objects, r, c);
    return sums;
}

TEST(BorderSums, HeightOfWhatStandsBeside) {
    // One cell of an object, with a hedge of 3 m on one of the 24 cells within two cells of it, another
    // object on a second, an unknown one and one below the ground. What is three cells away does not count.
    test::Town town(7, 7);
    town.block(3, 3, 4, 4, 106);
    town.surface.at(1, 5) = 103;
    town.surface.at(3, 4) = 120;
    town.surface.at(5, 1) = test::unknown;
    town.surface.at(2, 2) = 99;
    town.surface.at(0, 3) = 150;
    Mask objects(7, 7);
    objects.at(3, 3) = objects.at(3, 4) = 1;
    BorderSums sums;
    sums.add(town.scene(), objects, 3, 3);
    EXPECT_NEAR(sums.height_beside(), 3 / 22.0, 1e-9);
    EXPECT_EQ(BorderSums().height_beside(), 0);
}

TEST(BorderSums, RightAnglesAreThoseOfTheRasterOrTurned) {
    // A ramp along the rows, one along the columns and one along both: each alone keeps to one direction.
    for (const auto& [across, down] : {std::pair(1.0F, 0.0F), std::pair(0.0F, 1.0F), std::pair(1.0F, 2.0F)}) {
        test::Town town(5, 5);
        town.build([across = across, down = down](std::int32_t r, std::int32_t c) {
            return 100 + across * static_cast<float>(c) + down * static_cast<float>(r);
        });
        BorderSums sums;
        sums.add(town.scene(), Mask(5, 5, 1), 2, 2);
        EXPECT_NEAR(sums.right_angles(), 1, 1e-9);
    }
}

TEST(BorderSums, APyramidKeepsToRightAnglesAndAConeToNone) {
    const auto right_angles = [](const test::Shape& height) {
        test::Town town(41, 41);
        town.build(height);
        Mask ring(41, 41);
        for (std::int32_t r = 0; r < 41; ++r)
            for (std::int32_t c = 0; c < 41; ++c) {
                const double from_middle = std::hypot(r - 20, c - 20);
                ring.at(r, c) = from_middle > 12 && from_middle < 16 ? 1 : 0;
            }
        return sums_of(town, ring).right_angles();
    };
    EXPECT_GT(right_angles([](std::int32_t r, std::int32_t c) {
                  return 140 - static_cast<float>(std::max(std::abs(r - 20), std::abs(c - 20)));
              }),
              0.9);
    EXPECT_LT(right_angles([](std::int32_t r, std::int32_t c) {
                  return 140 - static_cast<float>(std::hypot(r - 20, c - 20));
              }),
              0.1);
}

TEST(BorderSums, ALevelSurfaceOrTheRastersBorderHasNoAngles) {
    test::Town town(3, 3);
    BorderSums sums;
    sums.add(town.scene(), Mask(3, 3, 1), 1, 1);
    EXPECT_EQ(sums.right_angles(), 0);
    town.surface.at(1, 1) = 110;
    sums.add(town.scene(), Mask(3, 3, 1), 0, 1);
    EXPECT_EQ(sums.right_angles(), 0);
}

}  // namespace
}  // namespace d2b
