#include "score/objects.hpp"

#include <gtest/gtest.h>

#include "score/shapes.hpp"

namespace d2b::test {
namespace {

TEST(Compare, sharesAreasOutToObjects) {
    Overlay overlay;
    // One found object over two of the reference, 6 by 10 and 2 by 10 of it; one alone.
    const Comparison result =
        compare({box(0, 0, 10, 10), box(50, 0, 60, 10)}, {box(-4, 0, 6, 10), box(8, 0, 18, 10)}, overlay);
    EXPECT_DOUBLE_EQ(result.found_area, 200);
    EXPECT_DOUBLE_EQ(result.reference_area, 200);
    EXPECT_DOUBLE_EQ(result.shared_area, 80);
    EXPECT_DOUBLE_EQ(result.found.shared[0], 80);
    EXPECT_EQ(result.found.shared[1], 0);
    EXPECT_DOUBLE_EQ(result.reference.shared[0], 60);
    EXPECT_DOUBLE_EQ(result.reference.shared[1], 20);
    ASSERT_EQ(result.pairs.size(), 2U);
    EXPECT_DOUBLE_EQ(result.pairs[0].iou, 60.0 / 140);
    EXPECT_DOUBLE_EQ(result.pairs[1].iou, 20.0 / 180);
    EXPECT_EQ(result.pairs[1].reference, 1U);
}

TEST(CountObjects, leavesSmallOnesOut) {
    const ScoredObjects objects{{box(0, 0, 7, 7), box(10, 0, 20, 5), box(30, 0, 40, 10), box(50, 0, 60, 10)},
                                {49, 50, 100, 100},
                                {49, 25, 49.9, 80}};
    const ObjectCount count = count_objects(objects, 50);
    EXPECT_EQ(count.large, 3U);    // 49 is too small, 50 is not
    EXPECT_EQ(count.covered, 2U);  // exactly half is enough
    EXPECT_EQ(count_objects(objects, 0).large, 4U);
}

TEST(Reaches, bearsRounding) {
    EXPECT_TRUE(at_least(0.1 + 0.7, 0.8));  // 0.7999999999999999
    EXPECT_FALSE(at_least(0.7999, 0.8));
    EXPECT_TRUE(at_least(0, 0));
}

}  // namespace
}  // namespace d2b::test
