#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "diagnose/search_warnings.hpp"

namespace d2b {
namespace {

/// Of a raster of elevations from 100 to 120.
RunReport report() {
    RunReport report;
    report.input = "dem";
    report.valid_points = 9;
    report.minimum = 100;
    report.maximum = 120;
    return report;
}

LevelPlan thresholds(std::vector<double> values) {
    LevelPlan plan;
    plan.thresholds = {{}, std::move(values)};
    return plan;
}

TEST(EmptyResult, SaysWhatExplainsMost) {
    RunReport nothing = report();
    nothing.valid_points = 0;
    EXPECT_EQ(explain_empty_result(thresholds({}), 0, {}, nothing),
              "'dem' has no valid point; the layers are empty");
    RunReport flat = report();
    flat.maximum = 100;
    EXPECT_EQ(explain_empty_result(thresholds({}), 0, {}, flat),
              "all valid points of 'dem' have the same elevation; no building was found");
    EXPECT_EQ(explain_empty_result(thresholds({}), 0, {}, report()),
              "no threshold lies between the lowest and the highest elevation; no building was found");
    DemInfo picture;
    picture.name = "dem";
    picture.bands = 3;
    EXPECT_TRUE(explain_empty_result(thresholds({110}), 0, picture, report())
                    .starts_with("no building was found: 'dem' has 3 bands, like a picture"));
    EXPECT_EQ(explain_empty_result(thresholds({110}), 0, {}, report()),
              "no building was found; a smaller -nf or -min_area, or more levels, may show some");
}

TEST(EmptyResult, LeavesToTheSearchWhatItKnowsBetter) {
    LevelPlan footprints = thresholds({});
    footprints.footprints = true;
    EXPECT_EQ(explain_empty_result(footprints, 0, {}, report()), "");
    EXPECT_EQ(explain_empty_result(thresholds({110}), 1, {}, report()), "");
}

}  // namespace
}  // namespace d2b
