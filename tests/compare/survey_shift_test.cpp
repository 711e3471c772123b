#include "compare/survey_shift.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "compare/find_changes.hpp"
#include "surveys.hpp"

namespace d2b::test {
namespace {

using namespace compare;

/// Ten houses of different sizes, 30 m apart, displaced.
std::vector<SurveyedBuilding> street(double east, double north) {
    std::vector<SurveyedBuilding> houses;
    for (int i = 0; i < 10; ++i) {
        const double x = 30 * i + east;
        houses.push_back(box_building(x, north, x + 8 + 0.5 * i, north + 10, 6));
    }
    return houses;
}

TEST(SurveyShift, isThatOfTheBuildings) {
    const SurveyShift shift = estimate_shift(street(0, 0), street(1.7, -1.2), 1, 1);
    EXPECT_NEAR(shift.east_m, 1.7, 1e-9);
    EXPECT_NEAR(shift.north_m, -1.2, 1e-9);
    EXPECT_EQ(shift.pairs, 10U);
}

TEST(SurveyShift, isInMetres) {
    const SurveyShift shift = estimate_shift(street(0, 0), street(3, 0), 1, 0.3048);
    EXPECT_NEAR(shift.east_m, 3 * 0.3048, 1e-9);
}

TEST(SurveyShift, doesNotDependOnChangedBuildings) {
    std::vector<SurveyedBuilding> after = street(2, 2);
    for (int i = 0; i < 3; ++i)  // grown to one side, by less than two fifths
        after[static_cast<std::size_t>(i)] = box_building(30 * i + 2, 2, 30 * i + 2 + 10.5 + 0.5 * i, 12, 6);
    after[5].heights.percentiles[p90_share] = 12;
    const SurveyShift shift = estimate_shift(street(0, 0), after, 1, 1);
    EXPECT_NEAR(shift.east_m, 2, 1e-9);
    EXPECT_NEAR(shift.north_m, 2, 1e-9);
    EXPECT_EQ(shift.pairs, 6U);
}

TEST(SurveyShift, needsThreeBuildings) {
    std::vector<SurveyedBuilding> before = street(0, 0);
    std::vector<SurveyedBuilding> after = street(1, 0);
    before.resize(2);
    after.resize(2);
    const SurveyShift shift = estimate_shift(before, after, 1, 1);
    EXPECT_EQ(shift.pairs, 0U);
    EXPECT_EQ(shift.east_m, 0);
    EXPECT_EQ(estimate_shift({}, {}, 1, 1).pairs, 0U);
}

TEST(SurveyShift, isNotThatOfTheNextHouse) {
    // Equal houses 3 m apart, so that each has neighbours within three cells of 2.5 m.
    std::vector<SurveyedBuilding> before;
    std::vector<SurveyedBuilding> after;
    for (int i = 0; i < 12; ++i) {
        before.push_back(box_building(6 * i, 0, 6 * i + 3, 8, 6));
        after.push_back(box_building(6 * i + 2.5, 5, 6 * i + 5.5, 13, 6));
    }
    const SurveyShift shift = estimate_shift(before, after, 2.5, 1);
    EXPECT_NEAR(shift.east_m, 2.5, 1e-9);
    EXPECT_NEAR(shift.north_m, 5, 1e-9);
}

TEST(SurveyShift, isAppliedBeforeBuildingsAreMatched) {
    // Shifts by two cells of 2.5 m, houses of 8 m and less than half of them shared.
    SurveyedPlace before = place_of(street(0, 0));
    SurveyedPlace after = place_of(street(5, 5));
    before.cell_m = after.cell_m = 2.5;
    const SurveyChanges changes = find_changes(before, after, 1);
    ASSERT_EQ(changes.buildings.size(), 10U);
    for (const ChangedBuilding& building : changes.buildings)
        EXPECT_EQ(building.change, Change::same);
}

}  // namespace
}  // namespace d2b::test
