#include <cmath>
#include <filesystem>
#include <sstream>

#include <nlohmann/json.hpp>

#include "cli/cli_test_case.hpp"
#include "cli/geometries.hpp"
#include "core/text.hpp"
#include "support/test_name.hpp"

namespace d2b::test {
namespace {

using nlohmann::json;

/// Real DEMs, which stand beside the project and are not part of it.
class Cities : public CliTest, public ::testing::WithParamInterface<const char*> {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        dem_ = std::string(D2B_SHARED) + "/cities/" + GetParam();
        if (!std::filesystem::exists(dem_))
            GTEST_SKIP() << missing_shared(dem_);
    }
    /// Runs, and looks at every polygon of the result.
    void expect_valid(Arguments arguments) const {
        arguments.insert(arguments.end(), {"-json", "--", dem_, "out.gpkg"});
        const json report = json::parse(run_well(arguments));
        EXPECT_EQ(report["dropped"]["polygon_repaired"], 0);
        EXPECT_EQ(report["dropped"]["outline_kept_traced"], 0);
        for (const char* name : {"buildings", "contours"}) {
            const Layer found = layer("out.gpkg", name);
            EXPECT_GT(found.records.size(), 0U) << name;
            for (const Record& record : found.records) {
                EXPECT_TRUE(record.valid()) << name << " " << record.text("id");
                EXPECT_GT(record.number("area_m2"), 0) << name << " " << record.text("id");
            }
        }
        EXPECT_EQ(report["output"]["buildings"], layer("out.gpkg", "buildings").records.size());
        EXPECT_EQ(report["output"]["contours"], layer("out.gpkg", "contours").records.size());
    }
    /// The smaller side of a cell.
    [[nodiscard]] double cell() const {
        const OpenDataset dem(GDALOpen(dem_.c_str(), GA_ReadOnly));
        std::array<double, 6> transform{};
        EXPECT_EQ(GDALGetGeoTransform(dem.get(), transform.data()), CE_None);
        return std::min(std::hypot(transform[1], transform[4]), std::hypot(transform[2], transform[5]));
    }

    std::string dem_;
};

TEST_P(Cities, areTracedWithThePresetThesis) {
    expect_valid({"-preset", "thesis"});
}

/// Nothing is found in some: terrain models have no buildings.
TEST_P(Cities, areSearchedForBuildingsByDefault) {
    preset_ = "";
    const ToolResult result = run({"-json", dem_, "out.gpkg"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json report = json::parse(result.out);
    const bool surface = report["output"]["buildings"] > 0;
    const bool terrain_model = dem_.find("dtm") != std::string::npos;
    EXPECT_TRUE(surface || terrain_model);
    std::istringstream lines(result.err);
    bool told = false;
    for (std::string line; std::getline(lines, line);) {
        const bool of_terrain_model = line.find("as in a terrain model (DTM)") != std::string::npos;
        EXPECT_EQ(line.starts_with("Warning: No building was found: "), !surface) << line;
        const bool of_sampling = line.starts_with("Warning: Points are thin: ");
        // Points are thin in two places, and seem to be where cells were doubled on the way to another grid.
        EXPECT_TRUE(!of_sampling || dem_.find("rochelle") != std::string::npos ||
                    dem_.find("stuttgart") != std::string::npos || dem_.find("4326") != std::string::npos)
            << line;
        const bool of_rounding = line.starts_with("Warning: Elevations are rounded to steps of 1 m") &&
                                 dem_.find("bilbao") != std::string::npos;
        EXPECT_TRUE(of_terrain_model || of_sampling || of_rounding ||
                    line.find(" % of the length of the buildings' outlines") != std::string::npos)
            << line;
        told = told || of_terrain_model;
    }
    EXPECT_EQ(told, terrain_model);
    EXPECT_EQ(report["dropped"]["polygon_repaired"], 0);
    const Layer buildings = layer("out.gpkg", "buildings");
    double sum = 0;
    for (const Record& record : buildings.records) {
        EXPECT_TRUE(record.valid()) << record.text("id");
        EXPECT_GT(record.number("height"), 0) << record.text("id");
        EXPECT_LT(record.number("height"), 400) << record.text("id");
        sum += record.area();
    }
    EXPECT_NEAR(OGR_G_Area(united(buildings).get()), sum, 1e-9 * sum);
    for (const Record& record : layer("out.gpkg", "contours").records)
        EXPECT_TRUE(record.valid()) << record.text("id");
}

TEST_P(Cities, areSimplifiedAsDisjointBandsOfCells) {
    expect_valid({"-trace", "cells", "-disjoint", "-simplify", number_text(0.9 * cell())});
}

TEST_P(Cities, areReprojected) {
    expect_valid({"-t_srs", "EPSG:4326"});
}

INSTANTIATE_TEST_SUITE_P(
    All, Cities,
    ::testing::Values("annarbor/dsm.tif", "annarbor/dsm_zfeet.tif", "annarbor/dtm.tif",
                      "annarbor/dtm_zfeet.tif", "athens_lod1_synthetic/dsm_400m_lod1_on_terrain.tif",
                      "athens_lod1_synthetic/dtm_400m.tif", "athens_lod1_synthetic/ndsm_lod1.tif",
                      "bilbao/dsm.tif", "bilbao/dtm.tif", "delft/derived_epsg4326_dsm.tif", "delft/dsm.tif",
                      "delft/dtm.tif", "larochelle_2m5/dsm.tif", "montpellier_als/dsm.tif", "seville/dsm.tif",
                      "seville/dtm.tif", "stbarth/dsm.tif", "stbarth/dtm.tif",
                      "stuttgart_csite2/derived_epsg4326_dsm.tif", "stuttgart_csite2/dsm.tif"),
    [](const auto& test) { return case_name(test.param); });

}  // namespace
}  // namespace d2b::test
