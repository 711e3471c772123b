#include "geometry/box_tree.hpp"

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace d2b {
namespace {

std::vector<Box> random_boxes(std::size_t count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0, 100);
    std::uniform_real_distribution<double> size(0, 10);
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = place(random);
        const double y = place(random);
        boxes.push_back({x, y, x + size(random), y + size(random)});
    }
    return boxes;
}

TEST(BoxTree, findsTheBoxesThatMeetAnother) {
    const std::vector<Box> boxes = random_boxes(300);
    const BoxTree tree(boxes);
    for (const Box& wanted : random_boxes(40)) {
        std::set<std::size_t> expected;
        for (std::size_t i = 0; i < boxes.size(); ++i)
            if (boxes[i].left <= wanted.right && wanted.left <= boxes[i].right &&
                boxes[i].low <= wanted.high && wanted.low <= boxes[i].high)
                expected.insert(i);
        std::set<std::size_t> found;
        tree.query(wanted, [&](std::size_t i) { EXPECT_TRUE(found.insert(i).second); });
        EXPECT_EQ(found, expected);
        EXPECT_EQ(tree.intersects_any(wanted), !expected.empty());
    }
}

TEST(BoxTree, mayBeEmpty) {
    const BoxTree tree({});
    tree.query({0, 0, 1, 1}, [](std::size_t) { FAIL(); });
    EXPECT_FALSE(tree.intersects_any({0, 0, 1, 1}));
}

TEST(BoxTree, holdsBoxesThatAreAllTheSame) {
    const BoxTree tree(std::vector<Box>(1000, Box{1, 1, 2, 2}));
    int count = 0;
    tree.query({2, 2, 3, 3}, [&](std::size_t) { ++count; });
    EXPECT_EQ(count, 1000);
    tree.query({2.1, 2, 3, 3}, [](std::size_t) { FAIL(); });
}

TEST(Box, isEmptyUntilSomethingIsAdded) {
    Box box;
    EXPECT_TRUE(box.empty());
    EXPECT_FALSE(box.intersects({-1e9, -1e9, 1e9, 1e9}));
    box.add(Position{3, 4});
    EXPECT_FALSE(box.empty());
    EXPECT_EQ(box.squared_distance({0, 0}), 25);
    EXPECT_EQ(box.squared_distance({3, 4}), 0);
}

}  // namespace
}  // namespace d2b
