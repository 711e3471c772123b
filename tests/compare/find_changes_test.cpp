// Changes of rectangles, worked out by hand.
#include "compare/find_changes.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "surveys.hpp"

namespace d2b::test {
namespace {

using namespace compare;

/// Names of the changes in their order: "same raised".
std::string names_of(const SurveyChanges& changes) {
    std::string text;
    for (const ChangedBuilding& building : changes.buildings)
        text +=
            (text.empty() ? "" : " ") + std::string(change_names[static_cast<std::size_t>(building.change)]);
    return text;
}

std::string changes_between(std::vector<SurveyedBuilding> before, std::vector<SurveyedBuilding> after) {
    return names_of(find_changes(place_of(std::move(before)), place_of(std::move(after)), 1));
}

/// The change of a single building of 10 by 10 m and 6 m.
std::string change_to(const SurveyedBuilding& after) {
    return changes_between({box_building(0, 0, 10, 10, 6)}, {after});
}

TEST(FindChanges, knowsEachChange) {
    const SurveyChanges changes =
        find_changes(place_of({box_building(0, 0, 10, 10, 6), box_building(100, 0, 110, 10, 6),
                               box_building(200, 0, 210, 10, 6, 0.7), box_building(300, 0, 310, 10, 9),
                               box_building(400, 0, 410, 10, 6), box_building(500, 0, 520, 10, 6)}),
                     place_of({box_building(600, 0, 610, 10, 4, 0.8), box_building(0, 0, 10, 10, 6),
                               box_building(100, 0, 110, 10, 8.5), box_building(300, 0, 310, 10, 6, 0.55),
                               box_building(400, 0, 413, 10, 6), box_building(500, 0, 515, 10, 6)}),
                     1);
    ASSERT_EQ(names_of(changes), "new same raised lowered grown shrunk gone");
    const ChangedBuilding& built = changes.buildings[0];
    EXPECT_EQ(built.new_indices, std::vector<std::size_t>{0});
    EXPECT_TRUE(built.old_indices.empty());
    EXPECT_TRUE(std::isnan(built.p90_old_m) && std::isnan(built.area_old_m2) && std::isnan(built.rise_m));
    EXPECT_EQ(built.p90_new_m, 4);
    EXPECT_EQ(built.confidence, 0.8);
    const ChangedBuilding& lowered = changes.buildings[3];
    EXPECT_EQ(lowered.rise_m, -3);
    EXPECT_EQ(lowered.confidence, 0.55);
    EXPECT_EQ(changes.buildings[4].area_old_m2, 100);
    EXPECT_EQ(changes.buildings[4].area_new_m2, 130);
    EXPECT_EQ(changes.buildings[5].area_new_m2, 150);
    const ChangedBuilding& gone = changes.buildings[6];
    EXPECT_EQ(gone.old_indices, std::vector<std::size_t>{2});
    EXPECT_EQ(gone.confidence, 0.7);
    EXPECT_TRUE(std::isnan(gone.p90_new_m) && std::isnan(gone.area_new_m2));
}

TEST(FindChanges, needsMoreThanTheLimits) {
    EXPECT_EQ(change_to(box_building(0, 0, 10, 10, 8)), "same");
    EXPECT_EQ(change_to(box_building(0, 0, 10, 10, 8.01)), "raised");
    EXPECT_EQ(change_to(box_building(0, 0, 10, 10, 4)), "same");
    EXPECT_EQ(change_to(box_building(0, 0, 10, 10, 3.99)), "lowered");
    EXPECT_EQ(change_to(box_building(0, 0, 12, 10, 6)), "same");  // by 20 m2
    EXPECT_EQ(change_to(box_building(0, 0, 12.01, 10, 6)), "grown");
    EXPECT_EQ(change_to(box_building(0, 0, 7.99, 10, 6)), "shrunk");
    // Grows by 90 m2, which are 9 % of 1000.
    EXPECT_EQ(changes_between({box_building(0, 0, 100, 10, 6)}, {box_building(0, 0, 109, 10, 6)}), "same");
    EXPECT_EQ(changes_between({box_building(0, 0, 100, 10, 6)}, {box_building(0, 0, 110.1, 10, 6)}), "grown");
}

TEST(FindChanges, putsHeightsBeforeAreas) {
    EXPECT_EQ(change_to(box_building(0, 0, 15, 10, 9)), "raised");
    EXPECT_EQ(change_to(box_building(0, 0, 5, 10, 3)), "lowered");
}

TEST(FindChanges, knowsNoRiseWithoutHeights) {
    EXPECT_EQ(change_to(box_building(0, 0, 10, 10, RoofHeights::nan)), "same");
}

TEST(FindChanges, comparesPartsTogether) {
    const std::vector<SurveyedBuilding> whole{box_building(0, 0, 20, 10, 10)};
    const std::vector<SurveyedBuilding> parts{box_building(0, 0, 10, 10, 10), box_building(10, 0, 20, 10, 5)};
    const SurveyChanges divided = find_changes(place_of(whole), place_of(parts), 1);
    ASSERT_EQ(names_of(divided), "same");
    EXPECT_EQ(divided.buildings[0].new_indices.size(), 2U);
    EXPECT_EQ(divided.buildings[0].area_new_m2, 200);
    EXPECT_NEAR(divided.buildings[0].p90_new_m, 10, 1e-3);
    EXPECT_EQ(changes_between(parts, whole), "same");
}

TEST(FindChanges, matchesWhatSharesHalfOfTheSmaller) {
    EXPECT_EQ(change_to(box_building(5, 0, 15, 10, 6)), "same");
    EXPECT_EQ(change_to(box_building(5.1, 0, 15.1, 10, 6)), "new gone");
    // Two of 900 m2 cover 40 % each.
    EXPECT_EQ(changes_between({box_building(0, 0, 10, 10, 6)},
                              {box_building(-86, 0, 4, 10, 6), box_building(6, 0, 96, 10, 6)}),
              "grown new");
}

TEST(FindChanges, isMirroredWhenSurveysAreSwapped) {
    const std::vector<SurveyedBuilding> one{box_building(0, 0, 10, 10, 6), box_building(50, 0, 60, 10, 9),
                                            box_building(100, 0, 110, 10, 6)};
    const std::vector<SurveyedBuilding> other{box_building(0, 0, 10, 10, 9), box_building(50, 0, 60, 10, 9),
                                              box_building(200, 0, 210, 10, 6)};
    EXPECT_EQ(changes_between(one, other), "raised same new gone");
    EXPECT_EQ(changes_between(other, one), "lowered same new gone");
}

TEST(FindChanges, countsOnlyWhereBothSurveysHaveData) {
    const auto with_heights = [](SurveyedPlace place, std::int32_t cols) {
        HeightGrid grid(20, cols, {0, 1, 0, 20, 0, -1});
        grid.set({0, 0, 20, cols}, std::vector<float>(20 * static_cast<std::size_t>(cols), 0));
        place.heights = SurveyHeights{std::move(grid)};
        return place;
    };
    // The old survey ends at 100 m, the new one at 300 m.
    const SurveyedPlace before =
        with_heights(place_of({box_building(0, 0, 10, 10, 6), box_building(96, 0, 106, 10, 6)}), 100);
    const SurveyedPlace after =
        with_heights(place_of({box_building(0, 0, 10, 10, 6), box_building(96, 0, 136, 10, 6),
                               box_building(92, 10, 104, 20, 6), box_building(200, 0, 210, 10, 6)}),
                     300);
    // Shared parts of those at the border are four tenths, one tenth and two thirds.
    const SurveyChanges changes = find_changes(before, after, 1);
    EXPECT_EQ(names_of(changes), "same new");
    EXPECT_EQ(changes.old_outside, 1U);
    EXPECT_EQ(changes.new_outside, 2U);
    EXPECT_NEAR(changes.buildings[1].area_new_m2, 80, 1e-9);
}

TEST(FindChanges, allowsHalfACellWhereCellsDiffer) {
    SurveyedPlace before = place_of({box_building(0, 0, 10, 10, 6)});
    SurveyedPlace after = place_of({box_building(0, 0, 14.9, 10, 6)});
    after.cell_m = 2.5;  // walls of 40 m by 1.25 m: 50 m2
    EXPECT_EQ(names_of(find_changes(before, after, 1)), "same");
    after.buildings[0] = box_building(0, 0, 15.1, 10, 6);
    EXPECT_EQ(names_of(find_changes(before, after, 1)), "grown");
}

TEST(FindChanges, looksForBuildingsInTheHeights) {
    const auto with_heights = [](std::vector<SurveyedBuilding> buildings, float height) {
        SurveyedPlace place = place_of(std::move(buildings));
        HeightGrid grid(10, 10, {0, 1, 0, 10, 0, -1});
        grid.set({0, 0, 10, 10}, std::vector<float>(100, height));
        place.heights = SurveyHeights{std::move(grid)};
        return place;
    };
    const std::vector<SurveyedBuilding> house{box_building(0, 0, 10, 10, 6)};
    const SurveyedPlace found = with_heights(house, 6);
    EXPECT_EQ(names_of(find_changes(with_heights({}, 0), found, 1)), "new");
    EXPECT_EQ(names_of(find_changes(with_heights({}, 5.5F), found, 1)), "same");
    EXPECT_EQ(names_of(find_changes(found, with_heights({}, 0), 1)), "gone");
    const SurveyChanges raised = find_changes(with_heights({}, 3), found, 1);
    ASSERT_EQ(names_of(raised), "raised");
    EXPECT_NEAR(raised.buildings[0].rise_m, 3, 1e-9);
    EXPECT_NEAR(raised.buildings[0].p90_old_m, 3, 1e-9);
    EXPECT_EQ(names_of(find_changes(found, with_heights({}, 3), 1)), "lowered");
}

TEST(FindChanges, takesNoTreeForGrowth) {
    // The building grows from 10 to 15 m; 5 m of its neighbourhood were ground, or already 4 m high.
    const auto with_heights = [](double width, float beside) {
        SurveyedPlace place = place_of({box_building(0, 0, width, 10, 6)});
        HeightGrid grid(10, 20, {0, 1, 0, 10, 0, -1});
        grid.set({0, 0, 10, 20}, std::vector<float>(200, beside));
        grid.set({0, 0, 10, 10}, std::vector<float>(100, 6));
        place.heights = SurveyHeights{std::move(grid)};
        return place;
    };
    EXPECT_EQ(names_of(find_changes(with_heights(10, 0), with_heights(15, 6), 1)), "grown");
    EXPECT_EQ(names_of(find_changes(with_heights(10, 4), with_heights(15, 6), 1)), "same");
    EXPECT_EQ(names_of(find_changes(with_heights(15, 6), with_heights(10, 0), 1)), "shrunk");
    EXPECT_EQ(names_of(find_changes(with_heights(15, 6), with_heights(10, 4), 1)), "same");
}

}  // namespace
}  // namespace d2b::test
