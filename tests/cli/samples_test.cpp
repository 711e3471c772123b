#include <cmath>
#include <filesystem>
#include <ostream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "cli/cli_test_case.hpp"
#include "cli/geometries.hpp"
#include "core/text.hpp"
#include "support/test_name.hpp"

namespace d2b::test {
namespace {

/// Whether each polygon lies in the other with a margin.
bool near(OGRGeometryH one, OGRGeometryH other, double margin) {
    const Geometry around_one(OGR_G_Buffer(one, margin, 30));
    const Geometry around_other(OGR_G_Buffer(other, margin, 30));
    return OGR_G_Contains(around_one.get(), other) != 0 && OGR_G_Contains(around_other.get(), one) != 0;
}

class Samples : public CliTest {
  protected:
    Layer buildings(const std::string& name, Arguments arguments) const {
        arguments.insert(arguments.begin(), {"-q", sample(name + ".tif"), "out.gpkg"});
        run_well(arguments);
        Layer result = layer("out.gpkg", "buildings");
        for (const Record& record : result.records)
            EXPECT_TRUE(record.valid()) << name;
        return result;
    }
    static Layer truth(const std::string& name) { return read_layer(sample("samples_truth.gpkg"), name); }

    /// The building that covers most of a true one.
    static const Record& match(const Layer& found, const Record& real) {
        const Record* best = nullptr;
        double most = 0;
        for (const Record& record : found.records) {
            const Geometry common(OGR_G_Intersection(record.geometry(), real.geometry()));
            if (OGR_G_Area(common.get()) > most) {
                most = OGR_G_Area(common.get());
                best = &record;
            }
        }
        if (best == nullptr)
            throw std::runtime_error("no building was found at " + real.text("kind"));
        return *best;
    }
    /// Each true building is found, every edge within a diagonal of a cell.
    static void expect_truth(const Layer& found, const Layer& real, double cell) {
        EXPECT_EQ(found.records.size(), real.records.size());
        for (const Record& record : real.records)
            EXPECT_TRUE(
                near(match(found, record).geometry(), record.geometry(), std::sqrt(2.0) * cell + 1e-9))
                << record.text("kind");
    }
};

TEST_F(Samples, thesisExampleHasOneRingOf24PointsAnd4Corners) {
    const Layer found = buildings("thesis_11x7", {"-fl", "15"});
    ASSERT_EQ(found.records.size(), 1U);
    // Points 12, 20, 64 and 56 of 11 columns: (row 1, col 1), (1, 9), (5, 9), (5, 1); centres of cells of 1
    // m.
    EXPECT_EQ(found.records[0].wkt(),
              "MULTIPOLYGON (((424801.5 4512998.5,424801.5 4512994.5,424809.5 4512994.5,424809.5 4512998.5,"
              "424801.5 4512998.5)))");
    EXPECT_EQ(buildings("thesis_11x7", {"-fl", "15", "-nf", "24", "-overwrite"}).records.size(), 1U);
    run_warned({"-q", "-nf", "25", "-fl", "15", "--", sample("thesis_11x7.tif"), "none.gpkg"},
               {"No building was found"});
    EXPECT_DOUBLE_EQ(found.records[0].number("height"), 50 * 0.3048);
}

TEST_F(Samples, thesisGridHasItsThreeShapes) {
    const Layer found = buildings("thesis_50x36", {"-fl", "4", "-trace", "cells"});
    const Layer real = truth("thesis_50x36");
    expect_truth(found, real, 1);
    for (const Record& record : real.records)
        EXPECT_DOUBLE_EQ(match(found, record).number("height"), record.number("roof_h"))
            << record.text("kind");
    const Record& l_shape = real.where("roof_h", 8);
    const Geometry difference(OGR_G_SymDifference(match(found, l_shape).geometry(), l_shape.geometry()));
    EXPECT_EQ(OGR_G_Area(difference.get()), 0);  // its edges are edges of cells
}

TEST_F(Samples, hotelHasItsSizeInFeetAndItsHeightInMetres) {
    const Layer found = buildings("hotel_70x85", {"-fl", "67.5", "-trace", "cells"});  // at half its height
    ASSERT_EQ(found.records.size(), 1U);
    const Layer real = truth("hotel_70x85");
    expect_truth(found, real, 1);
    const Record& hotel = found.records[0];
    EXPECT_EQ(hotel.vertices(), 13);  // an H, and closed
    const OGREnvelope box = hotel.box();
    EXPECT_NEAR((box.MaxX - box.MinX) / 0.3048, 176, 1 / 0.3048);
    EXPECT_NEAR((box.MaxY - box.MinY) / 0.3048, 200, 1 / 0.3048);
    EXPECT_NEAR(hotel.number("height"), 185 * 0.3048, 2 * 0.3048);
    EXPECT_NEAR(hotel.number("p50"), 135 * 0.3048, 1 * 0.3048);
    EXPECT_NEAR(hotel.number("roof"), 185, 1);  // in feet, as the DEM
    EXPECT_EQ(hotel.number("at_edge"), 0);
}

TEST_F(Samples, courtyardIsAnInteriorRing) {
    const Layer found = buildings("courtyard_utm", {"-fl", "521", "-trace", "cells"});
    ASSERT_EQ(found.records.size(), 1U);
    EXPECT_EQ(found.records[0].holes(), 1);
    const Layer real = truth("courtyard_utm");
    expect_truth(found, real, 0.5);
    EXPECT_NEAR(found.records[0].area(), real.records[0].area(), 0.03 * real.records[0].area());
}

TEST_F(Samples, areasInDegreesAreGeodesic) {
    const Layer found =
        buildings("degrees", {"-fl", "38.5", "-trace", "cells", "-min_area", "60"});  // without trees
    const Layer real = truth("degrees");
    EXPECT_EQ(found.crs, "WGS 84");
    expect_truth(found, real, 1.5e-5);
    // Square metres in a square degree, from the radii of curvature of WGS 84 at 52.0004 degrees.
    const double degree = M_PI / 180;
    const double e2 = 0.00669437999014;
    const double w = 1 - e2 * std::pow(std::sin(52.0004 * degree), 2);
    const double meridian = 6378137 * (1 - e2) / std::pow(w, 1.5);
    const double parallel = 6378137 / std::sqrt(w) * std::cos(52.0004 * degree);
    const double scale = meridian * parallel * degree * degree;
    for (const Record& record : found.records)
        EXPECT_NEAR(record.number("area_m2"), record.area() * scale, 0.005 + 1e-5 * record.number("area_m2"));
    for (const Record& record : real.records) {
        const Record& building = match(found, record);
        // Half a cell along the outline is more than the area lost or won.
        EXPECT_NEAR(building.number("area_m2"), record.area() * scale,
                    0.5 * 1.07 * building.number("perim_m"));
        EXPECT_NEAR(building.number("area_m2"), record.area() * scale, 0.08 * record.area() * scale);
    }
}

TEST_F(Samples, nodataIsNoPartOfAnything) {
    const Layer found = buildings("nodata", {"-fl", "34", "-trace", "cells"});
    const Layer real = truth("nodata");
    EXPECT_EQ(found.records.size(), real.records.size());
    int at_edge = 0;
    for (const Record& record : found.records)
        at_edge += record.number("at_edge") == 1 ? 1 : 0;
    EXPECT_EQ(at_edge, 1);
    for (const Record& record : real.records)
        (void)match(found, record);
    const OpenDataset dem(GDALOpen(sample("nodata.tif").c_str(), GA_ReadOnly));
    std::vector<double> values(120 * 100);
    ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(dem.get(), 1), GF_Read, 0, 0, 120, 100, values.data(), 120, 100,
                           GDT_Float64, 0, 0),
              CE_None);
    const auto valid = std::count_if(values.begin(), values.end(), [](double z) { return z > -9999; });
    EXPECT_LT(valid, 120 * 100);
    EXPECT_EQ(layer("out.gpkg", "contours").sum("n_points", 0), valid);
    buildings("nodata", {"-fl", "34", "-trace", "cells", "-nf", "0", "-overwrite"});  // no hole is filled
    double area = 0;
    int holes = 0;
    for (const Record& record : layer("out.gpkg", "contours").records) {
        area += record.number("level") == 0 ? record.area() : 0;
        holes += record.number("level") == 0 ? record.holes() : 0;
    }
    EXPECT_EQ(area, static_cast<double>(valid));
    EXPECT_GT(holes, 1);  // the lake and single cells
}

TEST_F(Samples, townRuns) {
    for (const Arguments& more : {Arguments{}, {"-trace", "cells", "-lod", "8"}, {"-i", "3", "-disjoint"}}) {
        Arguments arguments = more;
        arguments.push_back("-overwrite");
        EXPECT_GT(buildings("town", arguments).records.size(), 0U);
        const Layer stack = layer("out.gpkg", "contours");
        EXPECT_GT(stack.records.size(), 100U);
        for (const Record& record : stack.records)
            EXPECT_TRUE(record.valid());
    }
}

/// Returns the share of the common area in the area that either covers.
double overlap(OGRGeometryH one, OGRGeometryH other) {
    const Geometry common(OGR_G_Intersection(one, other));
    const Geometry either(OGR_G_Union(one, other));
    return OGR_G_Area(common.get()) / OGR_G_Area(either.get());
}

/// A sample with its truth, and how well the program does on it when no option is given.
struct Expected {
    const char* name;
    const char* truth;  ///< file and layer
    const char* layer;
    double least_overlap;
};

void PrintTo(const Expected& expected, std::ostream* stream) {
    *stream << expected.name;
}

class Defaults : public CliTest, public ::testing::WithParamInterface<Expected> {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        preset_ = "";
    }
    Layer found() const {
        run_well({"-q", sample(std::string(GetParam().name) + ".tif"), "out.gpkg"});
        return layer("out.gpkg", "buildings");
    }
    static Layer truth() { return read_layer(sample(GetParam().truth), GetParam().layer); }
};

TEST_P(Defaults, FindTheTruth) {
    const Layer buildings = found();
    const auto real = static_cast<double>(truth().records.size());
    EXPECT_NEAR(static_cast<double>(buildings.records.size()), real, 0.01 * real);  // the town has 363
    EXPECT_GE(overlap(united(buildings).get(), united(truth()).get()), GetParam().least_overlap);
}

TEST_P(Defaults, GiveValidPolygonsThatDoNotOverlap) {
    const Layer buildings = found();
    double sum = 0;
    for (const Record& record : buildings.records) {
        EXPECT_TRUE(record.valid());
        sum += record.area();
    }
    EXPECT_NEAR(OGR_G_Area(united(buildings).get()), sum, 1e-9 * sum);
    for (const Record& record : layer("out.gpkg", "contours").records)
        EXPECT_TRUE(record.valid());
}

INSTANTIATE_TEST_SUITE_P(
    Samples, Defaults,
    ::testing::Values(Expected{"thesis_50x36", "samples_truth.gpkg", "thesis_50x36", 0.93},
                      Expected{"hotel_70x85", "samples_truth.gpkg", "hotel_70x85", 0.92},
                      Expected{"courtyard_utm", "samples_truth.gpkg", "courtyard_utm", 0.97},
                      Expected{"degrees", "samples_truth.gpkg", "degrees", 0.93},
                      Expected{"nodata", "samples_truth.gpkg", "nodata", 0.96},
                      Expected{"town", "town_truth.gpkg", "blocks_dissolved", 0.94}),
    [](const auto& test) { return std::string(test.param.name); });

class DefaultHeights : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        preset_ = "";
    }
    /// Each true building with the one that overlaps it most.
    void expect_heights(const std::string& name, double metres, double tolerance) const {
        run_well({"-q", "-overwrite", sample(name + ".tif"), "out.gpkg"});
        const Layer found = layer("out.gpkg", "buildings");
        for (const Record& real : read_layer(sample("samples_truth.gpkg"), name).records) {
            const Record* best = nullptr;
            double most = 0.5;
            for (const Record& record : found.records)
                if (const double share = overlap(record.geometry(), real.geometry()); share > most) {
                    most = share;
                    best = &record;
                }
            ASSERT_NE(best, nullptr) << real.text("kind");
            // The top of a roof is seen at the middles of cells, and ground is that of the lower side.
            EXPECT_NEAR(best->number("roof"), real.number("ground") + real.number("roof_h"),
                        tolerance / metres)
                << real.text("kind");
            EXPECT_NEAR(best->number("ground"), real.number("ground"), tolerance / metres)
                << real.text("kind");
            EXPECT_NEAR(best->number("height"), metres * real.number("roof_h"), tolerance)
                << real.text("kind");
        }
    }
};

TEST_F(DefaultHeights, OnLevelGround) {
    expect_heights("thesis_50x36", 1, 1e-6);
    expect_heights("hotel_70x85", 0.3048, 0.3);
}

TEST_F(DefaultHeights, OnSlopes) {
    expect_heights("degrees", 1, 1.0);
    expect_heights("nodata", 1, 1.0);
    expect_heights("courtyard_utm", 1, 2.0);
}

/// 11 x 7 points of 1 m with a block of 9 x 5 in feet, which leaves too little ground to estimate one from.
TEST_F(DefaultHeights, OfTheThesisExample) {
    run_well({"-q", "-ground", "none", sample("thesis_11x7.tif"), "out.gpkg"});
    const Layer found = layer("out.gpkg", "buildings");
    ASSERT_EQ(found.records.size(), 1U);
    EXPECT_NEAR(found.records[0].area(), 9 * 5, 5);  // a cell or so in each corner
    EXPECT_DOUBLE_EQ(found.records[0].number("height"), 50 * 0.3048);
}

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
        const bool of_sampling = line.starts_with("Warning: Points are sparse: ");
        // Points are sparse in two places, and seem to be where cells were doubled for another grid.
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
