#include <random>

#include <gtest/gtest.h>

#include "read/raster_mosaic.hpp"

namespace d2b {
namespace {

TEST(CellBoxes, ThatShareCellsAreNotApart) {
    EXPECT_TRUE(are_disjoint({}));
    EXPECT_TRUE(are_disjoint({{{{0, 5}, {0, 5}}}}));
    EXPECT_TRUE(
        are_disjoint({{{{0, 5}, {0, 5}}}, {{{5, 9}, {0, 5}}}, {{{-4, 9}, {5, 6}}}, {{{0, 9}, {-3, 0}}}}));
    EXPECT_FALSE(are_disjoint({{{{0, 5}, {0, 5}}}, {{{0, 5}, {0, 5}}}}));
    EXPECT_FALSE(are_disjoint({{{{0, 9}, {0, 9}}}, {{{3, 4}, {3, 4}}}}));   // one within the other
    EXPECT_FALSE(are_disjoint({{{{3, 4}, {0, 9}}}, {{{0, 9}, {3, 4}}}}));   // a cross
    EXPECT_FALSE(are_disjoint({{{{0, 5}, {0, 5}}}, {{{4, 9}, {-3, 1}}}}));  // a corner
}

TEST(CellBoxes, AreApartAsEveryTwoAre) {
    std::mt19937 random(7);
    const auto pick = [&](int most) {
        return static_cast<double>(std::uniform_int_distribution(0, most)(random));
    };
    const auto meet = [](const CellBox& a, const CellBox& b) {
        return a[0][0] < b[0][1] && b[0][0] < a[0][1] && a[1][0] < b[1][1] && b[1][0] < a[1][1];
    };
    int apart = 0;
    for (int round = 0; round < 2000; ++round) {
        std::vector<CellBox> boxes;
        bool expected = true;
        for (int i = 0; i < 6; ++i) {
            const std::array<double, 2> at{pick(11), pick(11)};
            const CellBox box{{{at[0], at[0] + 1 + pick(3)}, {at[1], at[1] + 1 + pick(3)}}};
            for (const CellBox& other : boxes)
                expected = expected && !meet(box, other);
            boxes.push_back(box);
        }
        apart += expected ? 1 : 0;
        EXPECT_EQ(are_disjoint(boxes), expected);
    }
    EXPECT_GT(apart, 100);
    EXPECT_LT(apart, 1900);
}

}  // namespace
}  // namespace d2b
