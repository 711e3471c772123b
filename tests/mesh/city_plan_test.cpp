#include "dem2buildings_mesh/city_plan.hpp"

#include <string>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings_mesh/read_city.hpp"
#include "mesh/made_city.hpp"

namespace d2b::test {
namespace {

mesh::CityPlan plan_of(const std::vector<MadeBlock>& blocks) {
    return mesh::make_city_plan(mesh::parse_city(made_city(blocks).dump(), "x"), {});
}

std::string said_of(const std::vector<MadeBlock>& blocks) {
    try {
        static_cast<void>(plan_of(blocks));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(CityPlan, cutsWallsWhereNeighboursHaveCorners) {
    // The right one begins halfway up the wall of the left one: a node more than their eight corners have.
    const mesh::CityPlan plan =
        plan_of({made_box("a", 0, 0, 80, 80, 9000), made_box("b", 80, 40, 160, 80, 7000)});
    EXPECT_EQ(plan.plan.nodes.size(), 7U);
    EXPECT_EQ(plan.plan.edges.size(), 8U);
    EXPECT_EQ(plan.regions[0].top, 9000);
    EXPECT_EQ(plan.regions[1].building, 1);
    EXPECT_TRUE(plan.pinches.empty());
}

TEST(CityPlan, putsTouchingBuildingsOnOneLevel) {
    const mesh::CityPlan plan =
        plan_of({made_box("a", 0, 0, 80, 80, 9000, 500), made_box("b", 80, 0, 160, 80, 7000, -300),
                 made_box("c", 800, 0, 880, 80, 7000, 900)});
    EXPECT_EQ(plan.regions[0].base, -300);
    EXPECT_EQ(plan.regions[1].base, -300);
    EXPECT_EQ(plan.regions[2].base, 900);
}

TEST(CityPlan, takesPinchesApart) {
    const mesh::CityPlan plan =
        plan_of({made_box("a", 0, 0, 80, 80, 9000), made_box("b", 80, 80, 160, 160, 7000)});
    ASSERT_EQ(plan.pinches.size(), 1U);
    EXPECT_EQ(plan.pinches[0], (FinePoint{-80, 80}));
}

TEST(CityPlan, refusesTwoRoofsOverOnePlace) {
    EXPECT_EQ(said_of({made_box("a", 0, 0, 80, 80, 9000), made_box("b", 40, 40, 160, 160, 7000)}),
              "'x' has two roofs over one place, or roofs that cross, near 500002.500 5800002.500 (b); the "
              "file is damaged.");
    EXPECT_NE(said_of({made_box("a", 0, 0, 80, 80, 9000), made_box("b", 0, 0, 80, 80, 7000)}), "");
}

TEST(CityPlan, refusesARoofBelowTheGroundOfItsBlock) {
    EXPECT_EQ(said_of({made_box("a", 0, 0, 80, 80, -5, 0)}),
              "'x' has a roof of a that is not above the ground of its block; the file is damaged.");
}

}  // namespace
}  // namespace d2b::test
