#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "core/text.hpp"
#include "pipeline/made_town.hpp"

namespace d2b {
namespace {

using test::buildings;
using test::contours;
using test::doubtful;
using test::MadeTown;
using test::MemorySink;
using test::MemorySource;
using test::TownRun;

/// The confidences of what is found where nothing is refused.
std::vector<double> confidences() {
    TownRun town;
    town.options.detect.min_confidence = 0;
    town.run();
    std::vector<double> result;
    for (std::size_t i = 0; i < town.count(); ++i)
        result.push_back(std::get<BuildingRecord>(town.sink.features[buildings][i].record).confidence);
    std::sort(result.begin(), result.end());
    return result;
}

TEST(Doubtful, GoToALayerOfTheirOwn) {
    const std::vector<double> all = confidences();
    ASSERT_GE(all.size(), 3U);
    TownRun town;
    town.options.write.doubtful = true;
    town.options.detect.min_confidence = all.back();  // what is as sure as this is no doubt
    town.run();
    ASSERT_EQ(town.sink.layers.size(), 3U);
    EXPECT_EQ(town.sink.layers[doubtful].name, "doubtful");
    EXPECT_EQ(town.sink.layers[doubtful].fields.size(), town.sink.layers[buildings].fields.size());
    EXPECT_GE(town.count(), 1U);
    EXPECT_EQ(town.count() + town.count(doubtful), all.size());
    for (std::size_t i = 0; i < town.count(); ++i)
        EXPECT_EQ(town.sink.number(buildings, i, "confidence"), floor_to_hundredths(all.back()));
    for (std::size_t i = 0; i < town.count(doubtful); ++i) {
        EXPECT_LT(town.sink.number(doubtful, i, "confidence"), all.back());
        EXPECT_GT(town.sink.number(doubtful, i, "height"), 2);
        EXPECT_GE(town.sink.number(doubtful, i, "area_m2"), 25);
    }
    EXPECT_EQ(town.report.doubtful, static_cast<std::int64_t>(town.count(doubtful)));
    EXPECT_EQ(town.report.counted(Reason::building_doubtful),
              static_cast<std::int64_t>(town.count(doubtful)));
}

TEST(Doubtful, HaveNoContours) {
    TownRun town;
    town.options.write.doubtful = true;
    town.options.detect.min_confidence = confidences().back();
    town.run();
    std::set<std::int64_t> ids;
    for (std::size_t i = 0; i < town.count(); ++i)
        ids.insert(town.sink.whole(buildings, i, "id"));
    for (std::size_t i = 0; i < town.count(contours); ++i)
        EXPECT_EQ(ids.count(town.sink.whole(contours, i, "bldg_id")), 1U);
    EXPECT_EQ(town.report.contours, static_cast<std::int64_t>(town.count(contours)));
}

TEST(Doubtful, DoNotChangeWhatIsReportedOfBuildings) {
    TownRun with;
    TownRun without;
    for (TownRun* town : {&with, &without}) {
        town->options.detect.min_confidence = confidences().back();
        town->options.write.doubtful = town == &with;
        town->run();
    }
    EXPECT_GT(with.report.doubtful, 0);
    EXPECT_EQ(with.report.stack_rmse_m, without.report.stack_rmse_m);
    EXPECT_EQ(with.report.buildings, without.report.buildings);
    const auto& levels = without.report.levels;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        EXPECT_EQ(with.report.levels[i].contours, levels[i].contours);
        EXPECT_EQ(with.report.levels[i].points, levels[i].points);
    }
}

TEST(Doubtful, AreCountedWhereTheyAreNotWritten) {
    const std::vector<double> all = confidences();
    TownRun town;
    town.options.detect.min_confidence = 1;
    town.run();
    EXPECT_EQ(town.sink.layers.size(), 2U);
    EXPECT_EQ(town.count(), 0U);
    EXPECT_EQ(town.count(contours), 0U);
    EXPECT_EQ(town.report.counted(Reason::building_doubtful), static_cast<std::int64_t>(all.size()));
    EXPECT_EQ(town.report.doubtful, 0);
    ASSERT_EQ(town.report.warnings.size(), 1U);
    EXPECT_EQ(town.report.warnings[0], "No building was found: -min_confidence 1 leaves " +
                                           std::to_string(all.size()) +
                                           " out; a smaller value may show them.");
}

TEST(Doubtful, AreNoBuildingsInTheCanopy) {
    TownRun town;
    town.options.detect.min_confidence = 1;
    town.options.write.doubtful = true;
    town.run();
    EXPECT_EQ(town.count(), 0U);
    const std::size_t roof = MadeTown::index(26, 26);
    EXPECT_EQ(town.canopy.values[roof], town.height.values[roof]);
}

std::string only_warning(const MemorySink& sink, const RunReport& report) {
    EXPECT_TRUE(sink.finished);
    EXPECT_EQ(report.buildings, 0);
    EXPECT_EQ(report.contours, 0);
    EXPECT_EQ(report.warnings.size(), 1U);
    return report.warnings.empty() ? "" : report.warnings[0];
}

TEST(Nothing, ToFindIsAWarning) {
    const auto warning = [](std::int32_t rows, std::int32_t cols, const std::vector<double>& z) {
        MemorySource dem(rows, cols, z);
        MemorySink sink;
        test::MemoryRaster ground;
        const RunReport report = run({}, {dem}, {sink, &ground});
        EXPECT_TRUE(ground.finished);
        EXPECT_EQ(ground.values.size(), z.size());
        return only_warning(sink, report);
    };
    const double nan = std::nan("");
    EXPECT_EQ(warning(9, 9, std::vector<double>(81, nan)),
              "'memory' has no valid point; the layers are empty.");
    EXPECT_EQ(warning(1, 1, {nan}), "'memory' has no valid point; the layers are empty.");
    EXPECT_EQ(warning(1, 1, {7}),
              "All valid points of 'memory' have the same elevation; no building was found.");
    EXPECT_EQ(warning(30, 30, std::vector<double>(900, 7.0)),
              "All valid points of 'memory' have the same elevation; no building was found.");
    const auto covers = [](const std::string& extent) {
        return "No building was found: 'memory' covers " + extent +
               ", which is less than a building; give the right CRS with -a_srs, or a larger part of the "
               "raster.";
    };
    EXPECT_EQ(warning(1, 5, {0, 9, 9, 9, 0}), covers("5 m x 1 m"));
    EXPECT_EQ(warning(5, 1, {0, 9, nan, 9, 0}), covers("1 m x 5 m"));
    EXPECT_EQ(warning(2, 2, {0, 1, 0, 1}), covers("2 m x 2 m"));
}

}  // namespace
}  // namespace d2b
