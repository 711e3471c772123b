#include "pipeline/tiles/tile_numbers.hpp"

#include <gtest/gtest.h>

namespace d2b::tiles {
namespace {

using Numbers = std::vector<std::int64_t>;
using Buildings = std::vector<features::BuildingIds>;

/// Takes a contour of a tile down as FeatureWriter does, with the number that contours on it get.
void take(TileIds& numbers, std::size_t tile, std::int64_t number, std::int64_t building = 0) {
    features::AssignedIds& given = numbers.of(tile);
    given.written.push_back(number);
    if (building > 0)
        given.buildings.push_back({building, 0, 10 * building});
}

TEST(TileIds, WaitBetweenLevels) {
    TileIds numbers(std::make_unique<MemorySpool>(), 3);
    // Two tiles by turns on level 1; the last has nothing.
    take(numbers, 0, 1, 1);
    take(numbers, 1, 2, 2);
    take(numbers, 0, 3, 3);
    numbers.spool_level(1);
    take(numbers, 0, 4, 4);
    numbers.spool_level(0);

    // Level 2 has the numbers of level 1, by their places in the tile, and of its buildings.
    EXPECT_EQ(numbers.of(0).before, 0);
    EXPECT_EQ(numbers.of(0).written, (Numbers{1, 3, 4}));
    EXPECT_EQ(numbers.of(0).buildings, (Buildings{{1, 0, 10}, {3, 0, 30}, {4, 0, 40}}));
    EXPECT_EQ(numbers.of(1).written, (Numbers{2}));
    take(numbers, 0, 5);
    take(numbers, 0, 6);
    numbers.spool_level(0);
    take(numbers, 1, 7);
    numbers.spool_level(1);

    // Level 3 has lost those of level 1, and places count from behind them.
    EXPECT_EQ(numbers.of(0).before, 3);
    EXPECT_EQ(numbers.of(0).written, (Numbers{5, 6}));
    EXPECT_EQ(numbers.of(0).buildings, (Buildings{{1, 0, 10}, {3, 0, 30}, {4, 0, 40}}));
    take(numbers, 0, 8);
    numbers.spool_level(0);

    EXPECT_EQ(numbers.all(0).written, (Numbers{1, 3, 4, 5, 6, 8}));
    EXPECT_EQ(numbers.all(0).buildings, (Buildings{{1, 0, 10}, {3, 0, 30}, {4, 0, 40}}));
    EXPECT_EQ(numbers.all(1).written, (Numbers{2, 7}));
    EXPECT_EQ(numbers.all(1).buildings, (Buildings{{2, 0, 20}}));
    EXPECT_TRUE(numbers.all(2).written.empty());
    EXPECT_TRUE(numbers.all(2).buildings.empty());
}

TEST(TileIds, AreNotPutAsideTwice) {
    TileIds numbers(std::make_unique<MemorySpool>(), 1);
    take(numbers, 0, 1, 1);
    numbers.spool_level(0);
    numbers.spool_level(0);
    EXPECT_EQ(numbers.of(0).written, (Numbers{1}));
    EXPECT_EQ(numbers.all(0).written, (Numbers{1}));
}

}  // namespace
}  // namespace d2b::tiles
