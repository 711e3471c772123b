#include "features/surface_cluster.hpp"

#include <gtest/gtest.h>

#include "features/problem_layer.hpp"
#include "support/memory_io.hpp"

namespace d2b::features {
namespace {

/// Blocks of 100 by 100 steps, one beside the other, that stand at 1 m.
surface::SurfaceCluster blocks(const std::vector<std::int64_t>& tops) {
    surface::SurfaceCluster cluster;
    for (const std::int64_t top : tops) {
        const auto building = static_cast<std::int32_t>(cluster.buildings.size());
        const std::int64_t left = 100 * building;
        cluster.contours.push_back(
            {{{{0, left}, {0, left + 100}, {-100, left + 100}, {-100, left}}, {}}, -1, building, top});
        cluster.buildings.push_back({building + 1, 1000});
    }
    return cluster;
}

std::vector<std::int64_t> tops(const surface::SurfaceCluster& cluster) {
    std::vector<std::int64_t> tops;
    for (const surface::PartitionContour& contour : cluster.contours)
        tops.push_back(contour.top);
    return tops;
}

/// 10 m on 9,950 square steps are as much as 10.05 m on the rest of 10,000 of them.
TEST(FitRoofs, keepsTheVolumeThatPinchesTake) {
    surface::SurfaceCluster cluster = blocks({11000, 21000});
    EXPECT_TRUE(preserve_volumes({9950, 10020}, cluster));
    EXPECT_EQ(tops(cluster), (std::vector<std::int64_t>{11050, 20960}));
}

/// Heights that millimetres cannot hold, buildings that are not made, and those of another form by now.
TEST(FitRoofs, leavesOthersAlone) {
    surface::SurfaceCluster cluster = blocks({11000, 11000, 11000, 11000});
    EXPECT_FALSE(preserve_volumes({10000, 9999, 0, 5000}, cluster));
    EXPECT_EQ(tops(cluster), (std::vector<std::int64_t>(4, 11000)));
}

/// Tiers of one building, each as wide as is said and 1000 steps deep, beside the western edge.
DrawnCluster stack(const std::vector<surface::PartitionContour>& tiers) {
    DrawnCluster drawn;
    drawn.cluster.buildings = {{7, 0}};
    drawn.buildings.resize(1);
    for (const surface::PartitionContour& tier : tiers) {
        drawn.levels.push_back(tier.parent < 0 ? 1 : drawn.levels[static_cast<std::size_t>(tier.parent)] + 1);
        drawn.cluster.contours.push_back(tier);
    }
    return drawn;
}

surface::PartitionContour tier(std::int64_t from, std::int64_t to, std::int32_t parent, std::int64_t top) {
    return {{{{0, from}, {1000, from}, {1000, to}, {0, to}}, {}}, parent, 0, top};
}

struct Left {
    std::int64_t to;
    std::int32_t parent;
    std::int64_t top;

    friend bool operator==(const Left&, const Left&) = default;
};

std::vector<Left> left_of(const std::vector<surface::PartitionContour>& tiers) {
    DrawnCluster drawn = stack(tiers);
    merge_equal_tiers(drawn);
    EXPECT_EQ(drawn.levels.size(), drawn.cluster.contours.size());
    std::vector<Left> left;
    for (const surface::PartitionContour& contour : drawn.cluster.contours)
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
    surface::PartitionContour with_courtyard = tier(0, 10000, 0, 60);
    with_courtyard.outline.interiors = {{{100, 100}, {100, 300}, {300, 300}, {300, 100}}};
    EXPECT_EQ(left_of({tier(0, 10000, -1, 30), with_courtyard}).size(), 2U);
    with_courtyard.outline.interiors = {{{100, 100}, {100, 200}, {200, 200}, {200, 100}}};
    EXPECT_EQ(left_of({tier(0, 10000, -1, 30), with_courtyard}).size(), 1U);
}

/// A stack that narrows little by little loses no more than that either: the third tier is compared with the
/// rest of the first two.
TEST(MergeEqualTiers, oneAfterTheOther) {
    EXPECT_EQ(
        left_of({tier(0, 10000, -1, 10), tier(0, 9994, 0, 20), tier(0, 9988, 1, 30), tier(0, 9982, 2, 40)}),
        (std::vector<Left>{{10000, -1, 20}, {9988, 0, 40}}));
}

/// A tier beside an equal one and lower than that would be a hole in its roof.
TEST(MergeEqualTiers, whatIsCoveredGoesWithThem) {
    EXPECT_EQ(left_of({tier(0, 100000, -1, 10), tier(99990, 99995, 0, 20), tier(0, 99980, 0, 30)}),
              (std::vector<Left>{{100000, -1, 30}}));
    EXPECT_EQ(left_of({tier(0, 100000, -1, 10), tier(99990, 99995, 0, 20), tier(0, 99980, 0, 30),
                       tier(99991, 99993, 1, 50)}),
              (std::vector<Left>{{100000, -1, 30}, {99993, 0, 50}}));
}

/// Other tiers stand on the merged ones.
TEST(MergeEqualTiers, whatStandsOnThemStaysOnThem) {
    EXPECT_EQ(
        left_of({tier(0, 10000, -1, 10), tier(0, 9995, 0, 20), tier(0, 5000, 1, 30), tier(0, 4000, 2, 40)}),
        (std::vector<Left>{{10000, -1, 20}, {5000, 0, 30}, {4000, 1, 40}}));
}

FinePolygon roof_at(std::int64_t row, std::int64_t col) {
    return {{{row, col}, {row + 100, col}, {row + 100, col + 100}, {row, col + 100}}, {}};
}

/// Two buildings, 7 and 9; a step is half a unit of two metres, and rows run to the south.
struct TwoBuildings {
    TwoBuildings() {
        drawn.cluster.contours = {{roof_at(-300, 0), -1, 0, 10}, {roof_at(-200, 100), -1, 1, 10}};
        drawn.cluster.buildings = {{7, 0}, {9, 0}};
        drawn.buildings.resize(2);
        drawn.buildings[1].area_m2 = 44;
        frame.scale = {0.5, 0.5, 1};
        frame.translate = {1000, 2000, 0};
        frame.horizontal_metres = 2;
    }
    DrawnCluster drawn;
    SurfaceFrame frame;
};

TEST(SurfaceProblems, havePlaceAndSize) {
    TwoBuildings town;
    surface::MadeSurfaces made;
    made.repairs = {{{-200, 100}, {-197, 104}, false, {1, 0}}, {{-300, 0}, {-302, 0}, true, {1}}};
    const auto problems = surface_problems(town.drawn.cluster, made, {}, town.frame);
    ASSERT_EQ(problems.size(), 2U);
    EXPECT_EQ(problems[0].record.kind, "surface_corner_cut");
    EXPECT_EQ(problems[0].record.building, 7);
    EXPECT_EQ(problems[0].record.other, 9);
    EXPECT_EQ(problems[0].record.before, 0);
    EXPECT_EQ(problems[0].record.after, 5);  // five steps of a metre
    EXPECT_TRUE(problems[0].record.changed);
    EXPECT_EQ(problems[0].place.x, 1050);
    EXPECT_EQ(problems[0].place.y, 2100);
    EXPECT_EQ(problems[1].record.kind, "surface_notch_filled");
    EXPECT_EQ(problems[1].record.building, 9);
    EXPECT_EQ(problems[1].record.other, 0);
    EXPECT_EQ(problems[1].record.after, 2);
}

TEST(SurfaceProblems, nameBuildingsThatAreLost) {
    TwoBuildings town;
    surface::MadeSurfaces made;
    made.left_out = {9};
    std::vector<LostBuilding> lost{{3, 12, std::nullopt}};  // has no place
    add_left_out(town.drawn, made, lost);
    ASSERT_EQ(lost.size(), 2U);
    const auto problems = surface_problems(town.drawn.cluster, made, lost, town.frame);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems[0].record.kind, "surface_lost");
    EXPECT_EQ(problems[0].record.building, 9);
    EXPECT_EQ(problems[0].record.before, 44);
    EXPECT_FALSE(problems[0].record.changed);
    EXPECT_EQ(problems[0].place.x, 1050);
    EXPECT_EQ(problems[0].place.y, 2100);
}

}  // namespace
}  // namespace d2b::features
