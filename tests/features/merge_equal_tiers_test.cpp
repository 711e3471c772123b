#include <gtest/gtest.h>

#include "features/surface_cluster.hpp"

namespace d2b {
namespace {

/// Tiers of one building, each as wide as is said and 1000 steps deep, beside the western edge.
DrawnCluster stack(const std::vector<PartitionContour>& tiers) {
    DrawnCluster drawn;
    drawn.cluster.buildings = {{7, 0}};
    drawn.buildings.resize(1);
    for (const PartitionContour& tier : tiers) {
        drawn.levels.push_back(tier.parent < 0 ? 1 : drawn.levels[static_cast<std::size_t>(tier.parent)] + 1);
        drawn.cluster.contours.push_back(tier);
    }
    return drawn;
}

PartitionContour tier(std::int64_t from, std::int64_t to, std::int32_t parent, std::int64_t top) {
    return {{{{0, from}, {1000, from}, {1000, to}, {0, to}}, {}}, parent, 0, top};
}

struct Left {
    std::int64_t to;
    std::int32_t parent;
    std::int64_t top;

    friend bool operator==(const Left&, const Left&) = default;
};

std::vector<Left> left_of(const std::vector<PartitionContour>& tiers) {
    DrawnCluster drawn = stack(tiers);
    merge_equal_tiers(drawn);
    EXPECT_EQ(drawn.levels.size(), drawn.cluster.contours.size());
    std::vector<Left> left;
    for (const PartitionContour& contour : drawn.cluster.contours)
        left.push_back({contour.outline.exterior[2].col, contour.parent, contour.top});
    return left;
}

/// The limit itself is 0.1 % of the lower tier.
TEST(MergeEqualTiers, theHigherRoofStays) {
    EXPECT_EQ(left_of({tier(0, 10000, -1, 30), tier(0, 9990, 0, 60)}), (std::vector<Left>{{10000, -1, 60}}));
    EXPECT_EQ(left_of({tier(0, 10000, -1, 30), tier(0, 9989, 0, 60)}),
              (std::vector<Left>{{10000, -1, 30}, {9989, 0, 60}}));
    EXPECT_EQ(left_of({tier(0, 10000, -1, 30), tier(0, 10000, 0, 20)}), (std::vector<Left>{{10000, -1, 30}}));
}

/// A courtyard counts.
TEST(MergeEqualTiers, areasAreThoseWithoutCourtyards) {
    PartitionContour with_courtyard = tier(0, 10000, 0, 60);
    with_courtyard.outline.interiors = {{{100, 100}, {100, 300}, {300, 300}, {300, 100}}};
    EXPECT_EQ(left_of({tier(0, 10000, -1, 30), with_courtyard}).size(), 2U);
    with_courtyard.outline.interiors = {{{100, 100}, {100, 200}, {200, 200}, {200, 100}}};
    EXPECT_EQ(left_of({tier(0, 10000, -1, 30), with_courtyard}).size(), 1U);
}

/// A stack that narrows little by little loses no more than that either: the third tier is compared with what
/// stays of the first two.
TEST(MergeEqualTiers, oneAfterTheOther) {
    EXPECT_EQ(
        left_of({tier(0, 10000, -1, 10), tier(0, 9994, 0, 20), tier(0, 9988, 1, 30), tier(0, 9982, 2, 40)}),
        (std::vector<Left>{{10000, -1, 20}, {9988, 0, 40}}));
}

/// What stood beside an equal tier, lower than that, would be a hole in its roof.
TEST(MergeEqualTiers, whatIsCoveredGoesWithThem) {
    EXPECT_EQ(left_of({tier(0, 100000, -1, 10), tier(99990, 99995, 0, 20), tier(0, 99980, 0, 30)}),
              (std::vector<Left>{{100000, -1, 30}}));
    EXPECT_EQ(left_of({tier(0, 100000, -1, 10), tier(99990, 99995, 0, 20), tier(0, 99980, 0, 30),
                       tier(99991, 99993, 1, 50)}),
              (std::vector<Left>{{100000, -1, 30}, {99993, 0, 50}}));
}

/// Others stand on what is merged.
TEST(MergeEqualTiers, whatStandsOnThemStaysOnThem) {
    EXPECT_EQ(
        left_of({tier(0, 10000, -1, 10), tier(0, 9995, 0, 20), tier(0, 5000, 1, 30), tier(0, 4000, 2, 40)}),
        (std::vector<Left>{{10000, -1, 20}, {5000, 0, 30}, {4000, 1, 40}}));
}

}  // namespace
}  // namespace d2b
