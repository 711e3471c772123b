#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/score_case.hpp"

namespace d2b::test {
namespace {

using nlohmann::json;

class ScoreTool : public ScoreCase {
  protected:
    /// 100 m2 in both, 20 m2 of them shared by nobody: as Score.ofAShiftedSquare.
    void write_shifted() const {
        layer_of("found.gpkg", {"buildings", {{box(500002, 5800000, 500012, 5800010), 12}}});
        layer_of("reference.gpkg", {"buildings", {{box(500000, 5800000, 500010, 5800010), 10}}});
    }
    const Arguments both_{"found.gpkg", "reference.gpkg"};
};

TEST_F(ScoreTool, measuresAShiftedSquare) {
    write_shifted();
    const json result = score_json(both_);
    EXPECT_NEAR(result["iou"], 80.0 / 120, 1e-9);
    EXPECT_NEAR(result["completeness"], 0.8, 1e-9);
    EXPECT_NEAR(result["correctness"], 0.8, 1e-9);
    EXPECT_NEAR(result["shared_m2"], 80, 1e-6);
    EXPECT_NEAR(result["polis_m"], 1, 1e-9);
    EXPECT_NEAR(result["outline_rms_m"], std::sqrt((40 + 24 + 4 * 8.0 / 3) / 40), 1e-3);
    EXPECT_EQ(result["object_completeness"], 1);
    EXPECT_EQ(result["object_correctness"], 1);
    EXPECT_EQ(result["overlap"], 0);
    EXPECT_EQ(result["invalid"], 0);
    EXPECT_EQ(result["vertex_ratio"], 1);
    EXPECT_EQ(result["pairs"], 1);
    EXPECT_EQ(result["height_field"], "height");
    EXPECT_EQ(result["height_error"]["mean_m"], 2);
    EXPECT_EQ(result["metres"], 1);
    EXPECT_EQ(result["crs"], "ETRS89 / UTM zone 32N");
    EXPECT_EQ(result["found"]["layer"], "buildings");
    EXPECT_EQ(result["found"]["vertices"], 5);
}

TEST_F(ScoreTool, measuresShapes) {
    // Found: a square of 10 m at atan(6/8) = 36.87 degrees, and a triangle with a right angle, one of 26.6
    // degrees, and edges of 20, 10 and 22.4 m. One more square is outside of the area of interest.
    layer_of("found.gpkg", {.name = "buildings",
                            .features = {{"POLYGON((0 0,8 6,2 14,-6 8,0 0))"},
                                         {"POLYGON((40 0,60 0,60 10,40 0))"},
                                         {"POLYGON((900 0,908 6,902 14,894 8,900 0))"}}});
    // Reference: a square of 10 m at atan(8/6) = 53.13 degrees with a vertex on a wall; a rectangle of twice
    // the triangle.
    layer_of("reference.gpkg", {.name = "buildings",
                                .features = {{"POLYGON((2 0,8 8,0 14,-3 10,-6 6,2 0))"},
                                             {"POLYGON((40 0,60 0,60 10,40 10,40 0))"},
                                             {"POLYGON((900 0,910 0,905 10,900 0))"}}});
    layer_of("reference.gpkg", {"aoi", {{box(-100, -100, 100, 100)}}});
    RasterSpec dem;
    dem.cols = 100;
    dem.rows = 100;
    dem.values.assign(10000, 7);
    dem.transform = std::array<double, 6>{-150, 5.5, 0, 150, 0, -5.5};
    write(path("dem.tif"), dem);
    const ToolResult run = score({"-json", "-dem", "dem.tif", both_[0], both_[1]});
    ASSERT_EQ(run.status, 0) << run.err;
    const json shape = json::parse(run.out)["shape"];
    EXPECT_NEAR(shape["cell_m"], 5.5, 1e-9);
    const json& found = shape["found"];
    EXPECT_EQ(found["polygons"], 2);
    EXPECT_EQ(found["corners"], 7);
    EXPECT_EQ(found["corners_per_building"], 3.5);
    EXPECT_NEAR(found["right_share"], 5.0 / 7, 1e-9);
    EXPECT_NEAR(found["sharp45_share"], 1.0 / 7, 1e-9);
    EXPECT_NEAR(found["along_share"], (40 + 30) / (40 + 30 + 10 * std::sqrt(5)), 1e-9);
    EXPECT_NEAR(found["short_edge_share"], 5.0 / 7, 1e-9);  // the five of 10 m
    const json& reference = shape["reference"];
    EXPECT_EQ(reference["polygons"], 2);
    EXPECT_EQ(reference["corners"], 8);
    EXPECT_EQ(reference["corners_per_building"], 4);
    EXPECT_EQ(reference["right_share"], 1);
    EXPECT_EQ(reference["sharp45_share"], 0);
    EXPECT_NEAR(reference["along_share"], 1, 1e-9);
    EXPECT_NEAR(reference["short_edge_share"], 6.0 / 8, 1e-9);
    // The squares share 3/4 of their union or more, the triangle is half of its rectangle. The angles are
    // 16.26 and 0 degrees.
    const double angle = (std::atan2(8, 6) - std::atan2(6, 8)) * 180 / std::numbers::pi;
    EXPECT_EQ(shape["direction_pairs"], 2);
    EXPECT_NEAR(shape["direction_median_deg"], angle / 2, 1e-9);
    EXPECT_NEAR(shape["direction_p90_deg"], 0.9 * angle, 1e-9);
    // Nobody knows the cells without a raster.
    const json without = json::parse(score({"-json", both_[0], both_[1]}).out)["shape"];
    EXPECT_EQ(without["cell_m"], nullptr);
    EXPECT_EQ(without["found"]["short_edge_share"], nullptr);
    EXPECT_EQ(without["reference"]["short_edge_share"], nullptr);
    EXPECT_EQ(without["found"]["right_share"], found["right_share"]);
    EXPECT_EQ(score(both_).out.find("short edges"), std::string::npos);
    const std::string table = score({"-q", "-dem", "dem.tif", both_[0], both_[1]}).out;
    expect_has(table, "corners per building  3.50\n  of the reference    4.00\n");
    expect_has(table, "right corners         71.43 %\n  of the reference    100.00 %\n");
    expect_has(table, "sharp corners         14.29 %\n  of the reference    0.00 %\n");
    expect_has(table, "along main direction  75.79 %\n  of the reference    100.00 %\n");
    expect_has(table, "short edges           71.43 %\n  of the reference    75.00 %\n");
    expect_has(table, "direction, median     8.13 deg\ndirection, p90        14.63 deg\n");
}

TEST_F(ScoreTool, measuresCellsOnTheGround) {
    // At 60 degrees north cells of 18 by 9 seconds of arc are 279.00 by 278.53 m.
    RasterSpec dem;
    dem.cols = 4;
    dem.rows = 4;
    dem.values.assign(16, 7);
    dem.crs = "EPSG:4326";
    dem.transform = std::array<double, 6>{9, 0.005, 0, 60.005, 0, -0.0025};
    write(path("dem.tif"), dem);
    layer_of("found.gpkg", {.features = {{box(9.005, 60, 9.015, 60.003)}}, .epsg = 4326});
    const json shape = score_json({"-dem", "dem.tif", "found.gpkg", "found.gpkg"})["shape"];
    EXPECT_NEAR(shape["cell_m"], 278.53, 0.01);
    // The building is two cells wide and 334 m high.
    EXPECT_EQ(shape["found"]["short_edge_share"], 0.5);
    EXPECT_EQ(shape["direction_median_deg"], nullptr);
}

TEST_F(ScoreTool, hasTheSameKeysAlways) {
    write_shifted();
    const auto report = nlohmann::ordered_json::parse(score({"-json", both_[0], both_[1]}).out);
    std::string keys;
    for (const auto& [key, value] : report.items())
        keys += key + " ";
    EXPECT_EQ(
        keys,
        "version found reference crs metres limited min_object_m2 shared_m2 completeness correctness iou "
        "object_completeness object_correctness outline_m outline_near_m outline_rms_m overlap invalid "
        "vertex_ratio pairs polis_m height_field height_error shape warnings ");
}

TEST_F(ScoreTool, reprojectsTheFound) {
    // A ninth of a second of arc is some 3.4 m to the north: 9 degrees east is the middle of zone 32.
    layer_of("found.gpkg", {.features = {{box(9, 50, 9.001, 50.001)}}, .epsg = 4326});
    layer_of("reference.gpkg", {.features = {{box(500000, 5538630, 500071.7, 5538741.2)}}});
    const json result = score_json(both_);
    EXPECT_GT(result["iou"], 0.98);
    // Degrees on both sides are measured in metres, too: 71.7 by 111.2.
    const json local = score_json({"found.gpkg", "found.gpkg"});
    EXPECT_EQ(local["crs"], "local transverse Mercator projection");
    EXPECT_NEAR(local["found"]["area_m2"], 71.6956 * 111.2295, 2);
    EXPECT_NEAR(local["iou"], 1, 1e-9);
}

TEST_F(ScoreTool, measuresFeetInMetres) {
    layer_of("found.gpkg", {.features = {{box(13290000, 280000, 13290100, 280100)}}, .epsg = 2253});
    const json result = score_json({"found.gpkg", "found.gpkg"});
    EXPECT_EQ(result["metres"], 0.3048);
    EXPECT_NEAR(result["found"]["area_m2"], 929.0304, 1e-4);
}

TEST_F(ScoreTool, keepsToTheAreaOfInterest) {
    write_shifted();
    EXPECT_EQ(score_json(both_)["limited"], false);
    layer_of("reference.gpkg", {"aoi", {{box(500002, 5800000, 500010, 5800010)}}});
    const json by_default = score_json(both_);
    EXPECT_EQ(by_default["limited"], true);
    EXPECT_NEAR(by_default["iou"], 1, 1e-9);
    layer_of("reference.gpkg", {"left", {{box(500000, 5800000, 500004, 5800010)}}});
    EXPECT_NEAR(score_json({"-aoi", "left", both_[0], both_[1]})["iou"], 0.5, 1e-9);
    layer_of("right.gpkg", {"x", {{box(500008, 5800000, 500012, 5800010)}}});
    EXPECT_NEAR(score_json({"-aoi", "right.gpkg", both_[0], both_[1]})["iou"], 0.5, 1e-9);
}

TEST_F(ScoreTool, keepsToTheRasterAndItsData) {
    write_shifted();
    // Cells of 2 m from (500000, 5800010) on, 4 by 5: they end at x = 500008; the first column has no data.
    RasterSpec dem;
    dem.cols = 4;
    dem.rows = 5;
    dem.values.assign(20, 7);
    for (std::size_t row = 0; row < 5; ++row)
        dem.values[row * 4] = -1;
    dem.nodata = -1;
    dem.transform = std::array<double, 6>{500000, 2, 0, 5800010, 0, -2};
    write(path("dem.tif"), dem);
    const json result = score_json({"-dem", "dem.tif", both_[0], both_[1]});
    EXPECT_NEAR(result["found"]["area_m2"], 60, 1e-6);
    EXPECT_NEAR(result["iou"], 1, 1e-9);
}

TEST_F(ScoreTool, bearsEmptyLayers) {
    layer_of("found.gpkg", {"buildings"});
    layer_of("reference.gpkg", {"buildings", {{box(0, 0, 10, 10)}}});
    const json result =
        score_json(both_, "Warning: The layer 'buildings' of 'found.gpkg' has no polygons.\n");
    EXPECT_EQ(result["completeness"], 0);
    EXPECT_EQ(result["outline_rms_m"], nullptr);
    EXPECT_EQ(result["polis_m"], nullptr);
    EXPECT_EQ(result["height_error"], nullptr);
    EXPECT_EQ(result["warnings"].size(), 1U);
}

TEST_F(ScoreTool, countsInvalidPolygons) {
    layer_of("found.gpkg", {"buildings", {{"POLYGON((0 0,10 10,10 0,0 10,0 0))"}}});
    layer_of("reference.gpkg", {"buildings", {{box(0, 0, 10, 10)}}});
    const json result = score_json(both_);
    EXPECT_EQ(result["invalid"], 1);
    EXPECT_NEAR(result["completeness"], 0.5, 1e-9);
}

TEST_F(ScoreTool, refusesPlacesThatDoNotMeet) {
    layer_of("found.gpkg", {"buildings", {{box(0, 0, 10, 10)}}});
    layer_of("reference.gpkg", {"buildings", {{box(50, 0, 60, 10)}}});
    expect_refused(
        1,
        "'found.gpkg' (0 0 to 10 10) and 'reference.gpkg' (50 0 to 60 10) do not meet; check the files "
        "and their coordinate reference systems.",
        both_);
    layer_of("reference.gpkg", {"here", {{box(5, 0, 60, 10)}}});
    layer_of("reference.gpkg", {"aoi", {{box(30, 0, 60, 10)}}});
    expect_refused(
        1,
        "'found.gpkg' (0 0 to 10 10) and the area of interest, layer 'aoi' of 'reference.gpkg', (30 0 to "
        "60 10) do not meet; check the files and their coordinate reference systems.",
        {"-reference_layer", "here", both_[0], both_[1]});
}

TEST_F(ScoreTool, refusesAnAreaOfInterestWithoutData) {
    layer_of("found.gpkg", {"buildings", {{box(0, 0, 100, 10)}}});
    layer_of("reference.gpkg", {"buildings", {{box(0, 0, 100, 10)}}});
    layer_of("reference.gpkg", {"aoi", {{box(0, 0, 10, 10)}}});
    RasterSpec dem;
    dem.values = {1};
    dem.transform = std::array<double, 6>{50, 10, 0, 10, 0, -10};
    write(path("dem.tif"), dem);
    expect_refused(1, "The area of interest has no cell of 'dem.tif' with data; check both files.",
                   {"-dem", "dem.tif", both_[0], both_[1]});
    layer_of("empty.gpkg", {"e"});
    expect_refused(
        1, "The area of interest, layer 'e' of 'empty.gpkg', has no polygons; give another one with -aoi.",
        {"-aoi", "empty.gpkg", both_[0], both_[1]});
}

TEST_F(ScoreTool, refusesMissingLayersAndFields) {
    write_shifted();
    expect_refused(2, "'found.gpkg' has no layer 'houses'; it has 'buildings'.",
                   {"-layer", "houses", both_[0], both_[1]});
    expect_refused(2,
                   "The layer 'buildings' of 'reference.gpkg' has no field 'tall'; its fields are 'height'.",
                   {"-height_field", "tall", both_[0], both_[1]});
    const ToolResult missing = score({"nothing.gpkg", both_[1]});
    EXPECT_EQ(missing.status, 1);
    expect_has(missing.err, "'nothing.gpkg' cannot be opened as a vector dataset: ");
}

TEST_F(ScoreTool, saysWhatItIs) {
    EXPECT_EQ(score({}).status, 2);
    expect_has(score({}).err, "Usage: dem2buildings_score [options] <found> <reference>");
    expect_has(score({"--help"}).out, "Exit status: 0 done, 1 failed, 2 wrong usage.");
    expect_has(score({"--version"}).out, "dem2buildings_score 0.");
    expect_has(score({"-man"}).out, ".TH DEM2BUILDINGS_SCORE 1");
    write_shifted();
    expect_has(score(both_).out, "IoU                   66.67 %\n");
    EXPECT_EQ(score({"-q", both_[0], both_[1]}).out.find("found.gpkg"), std::string::npos);
}

/// Figures of the independent scorer beside the real DEMs, which burns everything into cells four
/// times finer than the DSM's:
///   score_footprints.py cities/<city> cities/<city>/reference_buildings.gpkg --layer <layer>
struct CityScore {
    const char* city;
    const char* layer;
    double completeness, correctness, iou, object_completeness, object_correctness, outline_rms_m,
        vertex_ratio;
};

class ScoreCities : public CliTest, public ::testing::WithParamInterface<CityScore> {};

TEST_P(ScoreCities, agreeWithTheIndependentScorer) {
    const CityScore& expected = GetParam();
    const std::string folder = std::string(D2B_SHARED) + "/cities/" + expected.city;
    if (!std::filesystem::exists(folder + "/dsm.tif"))
        GTEST_SKIP() << missing_shared(folder + "/dsm.tif");
    const std::string reference = folder + "/reference_buildings.gpkg";
    const ToolResult run = run_tool({D2B_SCORE_TOOL, "-json", "-dem", folder + "/dsm.tif", "-layer",
                                     expected.layer, reference, reference});
    ASSERT_EQ(run.status, 0) << run.err;
    const json result = json::parse(run.out);
    EXPECT_NEAR(result["completeness"], expected.completeness, 0.005);
    EXPECT_NEAR(result["correctness"], expected.correctness, 0.005);
    EXPECT_NEAR(result["iou"], expected.iou, 0.005);
    const double one_object = 1.001 / result["reference"]["objects"].get<double>();
    EXPECT_NEAR(result["object_completeness"], expected.object_completeness, one_object);
    const double one_found = 1.001 / result["found"]["objects"].get<double>();
    EXPECT_NEAR(result["object_correctness"], expected.object_correctness, one_found);
    EXPECT_NEAR(result["outline_rms_m"], expected.outline_rms_m, 0.05);
    EXPECT_NEAR(result["vertex_ratio"], expected.vertex_ratio, 0.005);
    EXPECT_NEAR(result["overlap"], 0, 1e-5);
    EXPECT_EQ(result["invalid"], 0);
    EXPECT_LE(result["iou"], 1);
}

INSTANTIATE_TEST_SUITE_P(
    All, ScoreCities,
    ::testing::Values(CityScore{"annarbor", "buildings", 1, 1, 1, 1, 1, 0, 1},
                      CityScore{"larochelle_2m5", "buildings", 1, 1, 1, 1, 1, 0, 1},
                      CityScore{"montpellier_als", "buildings", 1, 1, 1, 1, 1, 0, 1},
                      CityScore{"delft", "buildings", 1, 1, 1, 1, 1, 0.095, 2.078},
                      CityScore{"delft", "class6_polygons", 0.9836, 0.8564, 0.8444, 1, 1, 0.756, 5.772},
                      CityScore{"bilbao", "buildings", 1, 1, 1, 1, 1, 0, 1},
                      CityScore{"seville", "buildings", 1, 1, 1, 1, 1, 0, 1},
                      CityScore{"stbarth", "buildings", 1, 1, 1, 1, 1, 0, 1}),
    [](const auto& test) { return std::string(test.param.city) + "_" + test.param.layer; });

}  // namespace
}  // namespace d2b::test
