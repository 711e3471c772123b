#include <cmath>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/cli_test_case.hpp"

namespace d2b::test {
namespace {

using nlohmann::json;

/// What the independent scorer that stands beside the real DEMs gives, which burns everything into cells four
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
