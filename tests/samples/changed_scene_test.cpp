// Scenes before and after changes, and their truth.
#include "changed_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "make_scene.hpp"
#include "support/error_of.hpp"

namespace d2b::test {
namespace {

using namespace sample;

ChangedScene changed_estate() {
    return change_scene(choose_scene("estate_lidar2").place.make(1), 1);
}

const Building* with_number(const std::vector<Building>& buildings, std::int64_t id) {
    const auto found = std::find_if(buildings.begin(), buildings.end(),
                                    [&](const Building& building) { return building.id == id; });
    return found == buildings.end() ? nullptr : &*found;
}

TEST(ChangedScene, HasTheBuildingsThatItsTruthSays) {
    const ChangedScene scene = changed_estate();
    ASSERT_EQ(scene.truth.size(), 100U);
    std::map<TrueChange, int> counts;
    for (const TruthOfChange& truth : scene.truth) {
        ++counts[truth.change];
        const Building* const before = with_number(scene.before.buildings, truth.building.id);
        const Building* const after = with_number(scene.after.buildings, truth.building.id);
        ASSERT_EQ(before == nullptr, truth.change == TrueChange::built);
        ASSERT_EQ(after == nullptr, truth.change == TrueChange::gone);
        if (before == nullptr || after == nullptr)
            continue;
        const double rise = after->top() - before->top();
        EXPECT_NEAR(rise,
                    truth.change == TrueChange::raised    ? floor_m
                    : truth.change == TrueChange::lowered ? -floor_m
                                                          : 0,
                    1e-9);
        EXPECT_EQ(after->footprint.exterior, truth.building.footprint.exterior);
    }
    for (const TrueChange change :
         {TrueChange::built, TrueChange::gone, TrueChange::raised, TrueChange::lowered}) {
        EXPECT_GE(counts[change], 3) << change_name(change);
        EXPECT_LE(counts[change], 20) << change_name(change);
    }
}

TEST(ChangedScene, HasTreesThatGrow) {
    const ChangedScene scene = changed_estate();
    std::size_t grown = 0;
    for (const Tree& before : scene.before.trees)
        for (const Tree& after : scene.after.trees)
            if (before.trunk == after.trunk) {
                ++grown;
                EXPECT_GE(after.height, 1.1 * before.height);
                EXPECT_LE(after.height, 1.4 * before.height);
            }
    EXPECT_GT(grown, 10U);
    EXPECT_LE(grown, scene.before.trees.size());
    EXPECT_NE(scene.before.seed, scene.after.seed);
}

TEST(ChangedScene, ChangesOnlySingleBuildings) {
    const ChangedScene scene = change_scene(choose_scene("rows_lidar2").place.make(1), 1);
    for (const TruthOfChange& truth : scene.truth)
        EXPECT_EQ(truth.change, TrueChange::same);
}

TEST(ChangedScene, NamesTheSurveysThatThereAre) {
    EXPECT_EQ(choose_survey("thin").cell, 2);
    const std::string error = error_of([] { static_cast<void>(choose_survey("sonar")); });
    EXPECT_EQ(error.rfind("There is no survey sonar; the surveys are lidar20, lidar8, ", 0), 0U) << error;
}

}  // namespace
}  // namespace d2b::test
