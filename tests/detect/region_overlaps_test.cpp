#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "detect/regions.hpp"
#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

Regions regions_of(const std::vector<std::string>& rows) {
    return connected_regions(test::drawn(rows), 1, 0, test::threads());
}

TEST(RegionOverlaps, CountsTheCellsOfEachPair) {
    const Regions one = regions_of({"##..###", "##..###", ".......", "####..."});
    const Regions other = regions_of({".######", "..#...#", "#......", "#.##..."});
    using Overlaps = std::vector<RegionOverlap>;
    EXPECT_EQ(region_overlaps(one, other), (Overlaps{{1, 1, 1}, {2, 1, 4}, {3, 2, 1}, {3, 3, 2}}));
    EXPECT_EQ(region_overlaps(other, one), (Overlaps{{1, 1, 1}, {1, 2, 4}, {2, 3, 1}, {3, 3, 2}}));
}

TEST(RegionOverlaps, HolderIsTheOneWithMostCells) {
    const Regions one = regions_of({"#####", ".....", "####.", ".....", "#...."});
    const Regions other = regions_of({"##.##", "...#.", "##.##", ".....", "....#"});
    // Of two with as many cells the first; the last region is in none.
    EXPECT_EQ(containing_regions(one, other), (std::vector<Label>{0, 1, 3, 0}));
}

TEST(RegionOverlaps, OfNothingThereAreNone) {
    const Regions none = regions_of({"...", "..."});
    const Regions some = regions_of({"##.", "..."});
    EXPECT_TRUE(region_overlaps(none, some).empty());
    EXPECT_EQ(containing_regions(some, none), (std::vector<Label>{0, 0}));
}

}  // namespace
}  // namespace d2b
