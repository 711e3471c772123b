#include <gtest/gtest.h>

#include "features/problem_layer.hpp"
#include "support/memory_io.hpp"

namespace d2b {
namespace {

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
    MadeSurfaces made;
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
    MadeSurfaces made;
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
}  // namespace d2b
