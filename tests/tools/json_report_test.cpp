#include "dem2buildings/json_report.hpp"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "dem2buildings/version.hpp"

namespace d2b::test {
namespace {

using Json = nlohmann::ordered_json;

RunReport filled() {
    RunReport report;
    report.input = "in \"quoted\".tif";
    report.driver = "GTiff";
    report.output = "out.gpkg";
    report.crs = "ETRS89 / UTM zone 32N";
    report.output_crs = "WGS 84";
    report.units = {"metre", "CRS", 1, "US survey foot", "band", 1200.0 / 3937, "geodesic"};
    report.rows = 3;
    report.cols = 4;
    report.points = 12;
    report.valid_points = 11;
    report.minimum = -1.5;
    report.maximum = 20.1;
    report.mean = 1.0 / 3;
    report.standard_deviation = 0.1;
    report.levels = {{0, -1.5, 1, 11}, {1, 2.5, 3, 7}};
    report.doubtful = 1;
    report.stack_rmse_m = 0.75;
    report.contours = 4;
    report.buildings = 2;
    report.vertices = 99;
    report.building_outlines = {10, 0, 0.5};
    report.contour_outlines = {20, 5, 1.5};
    report.count(Reason::contour_short, 5);
    report.count(Reason::polygon_repaired, 6);
    report.seconds[0] = 0.25;
    report.surface = SurfaceReport{{391000, 5820000, -3}, 5, 4, 100, 184};
    report.cuts = {{1, 2.5}, {2, 0.75}};
    report.sampling = SamplingReport{0.25, 1.5, {}, 0.25};
    report.peak_memory_bytes[static_cast<std::size_t>(Stage::write)] = 1LL << 40;
    report.warnings = {"first", "second"};
    return report;
}

TEST(JsonReport, readsBackAsItWas) {
    const Json json = Json::parse(json_report(filled()));
    EXPECT_EQ(json["version"], version);
    EXPECT_EQ(json["surface"], (Json{{"origin", {391000, 5820000, -3}},
                                     {"buildings", 5},
                                     {"blocks", 4},
                                     {"points", 100},
                                     {"triangles", 184}}));
    EXPECT_FALSE(Json::parse(json_report({})).contains("surface"));
    EXPECT_EQ(json["cuts"], Json::parse(R"([{"level":1,"rmse_m":2.5},{"level":2,"rmse_m":0.75}])"));
    EXPECT_FALSE(Json::parse(json_report({})).contains("cuts"));
    EXPECT_EQ(
        json["sampling"],
        Json::parse(
            R"({"filled_share":0.25,"points_per_cell":1.5,"step_width_cells":null,"value_step":0.25})"));
    EXPECT_FALSE(Json::parse(json_report({})).contains("sampling"));
    EXPECT_EQ(json["input"], (Json{{"name", "in \"quoted\".tif"},
                                   {"driver", "GTiff"},
                                   {"crs", "ETRS89 / UTM zone 32N"},
                                   {"rows", 3},
                                   {"cols", 4},
                                   {"points", 12},
                                   {"valid_points", 11},
                                   {"minimum", -1.5},
                                   {"maximum", 20.1},
                                   {"mean", 1.0 / 3},
                                   {"standard_deviation", 0.1}}));
    EXPECT_EQ(json["units"], (Json{{"horizontal", "metre"},
                                   {"horizontal_decided_by", "CRS"},
                                   {"horizontal_metres", 1.0},
                                   {"vertical", "US survey foot"},
                                   {"vertical_decided_by", "band"},
                                   {"vertical_metres", 1200.0 / 3937},
                                   {"areas", "geodesic"}}));
    EXPECT_EQ(json["levels"], Json::parse(R"([{"level":0,"threshold":-1.5,"contours":1,"points":11},
                                              {"level":1,"threshold":2.5,"contours":3,"points":7}])"));
    EXPECT_EQ(
        json["output"],
        Json::parse(
            R"({"name":"out.gpkg","crs":"WGS 84","buildings":2,"doubtful":1,"stack_rmse_m":0.75,"contours":4,"vertices":99,
                "outline_length_m":{"buildings":{"fitted":10.0,"simplified":0.0,"traced":0.5},
                                    "contours":{"fitted":20.0,"simplified":5.0,"traced":1.5}}})"));
    EXPECT_EQ(json["warnings"], Json::parse(R"(["first","second"])"));
}

TEST(JsonReport, namesEveryReasonAndEveryStage) {
    const Json json = Json::parse(json_report(filled()));
    ASSERT_EQ(json["dropped"].size(), reason_names.size());
    for (const std::string_view name : reason_names)
        EXPECT_EQ(json["dropped"][std::string(name)], name == "contour_short"      ? 5
                                                      : name == "polygon_repaired" ? 6
                                                                                   : 0)
            << name;
    ASSERT_EQ(json["stages"].size(), stage_names.size());
    for (const std::string_view name : stage_names) {
        const Json& stage = json["stages"][std::string(name)];
        EXPECT_EQ(stage["seconds"], name == "read" ? 0.25 : 0.0) << name;
        EXPECT_EQ(stage["peak_memory_bytes"], name == "write" ? 1LL << 40 : 0) << name;
    }
}

TEST(JsonReport, keepsTheOrderOfItsKeys) {
    const Json json = Json::parse(json_report({}));
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items())
        keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"version", "input", "units", "levels", "output", "dropped",
                                              "threads", "stages", "warnings"}));
    EXPECT_EQ(json["levels"], Json::array());
    EXPECT_EQ(json["warnings"], Json::array());
}

TEST(JsonReport, survivesWhatJsonCannotHold) {
    RunReport report;
    report.mean = std::numeric_limits<double>::quiet_NaN();
    report.levels = {{1, report.mean, 2, 3}};
    report.input = "bad\xff";
    report.warnings = {"line\nbreak"};
    const Json json = Json::parse(json_report(report));
    EXPECT_TRUE(json["input"]["mean"].is_null());
    EXPECT_EQ(json["levels"], Json::parse(R"([{"level":1,"threshold":null,"contours":2,"points":3}])"));
    EXPECT_EQ(json["input"]["name"], "bad\xef\xbf\xbd");
    EXPECT_EQ(json["warnings"][0], "line\nbreak");
}

TEST(JsonReport, endsWithALineFeed) {
    EXPECT_TRUE(json_report({}).ends_with("}\n"));
}

}  // namespace
}  // namespace d2b::test
