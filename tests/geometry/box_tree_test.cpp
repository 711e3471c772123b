#include "geometry/box_tree.hpp"

#include <cmath>
#include <limits>
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
    }
}

TEST(BoxTree, findsTheNearest) {
    const std::vector<Box> boxes = random_boxes(300);
    const BoxTree tree(boxes);
    const auto from = [&](Position p, std::size_t i) {  // to the centre of the box
        const double dx = (boxes[i].left + boxes[i].right) / 2 - p.x;
        const double dy = (boxes[i].low + boxes[i].high) / 2 - p.y;
        return dx * dx + dy * dy;
    };
    for (const Position p : {Position{50, 50}, Position{-20, 3}, Position{99, 120}}) {
        double expected = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < boxes.size(); ++i)
            expected = std::min(expected, from(p, i));
        const auto distance = [&](std::size_t i) { return from(p, i); };
        EXPECT_EQ(tree.nearest(p, std::numeric_limits<double>::infinity(), distance), expected);
        EXPECT_EQ(tree.nearest(p, expected / 2, distance), expected / 2);
    }
}

TEST(BoxTree, mayBeEmpty) {
    const BoxTree tree({});
    tree.query({0, 0, 1, 1}, [](std::size_t) { FAIL(); });
    EXPECT_EQ(tree.nearest({0, 0}, 7, [](std::size_t) { return 0.0; }), 7);
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
    EXPECT_FALSE(box.meets({-1e9, -1e9, 1e9, 1e9}));
    box.add(Position{3, 4});
    EXPECT_FALSE(box.empty());
    EXPECT_EQ(box.squared_distance({0, 0}), 25);
    EXPECT_EQ(box.squared_distance({3, 4}), 0);
}

}  // namespace
}  // namespace d2b
