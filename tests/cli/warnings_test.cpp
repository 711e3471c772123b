#include <cmath>
#include <fstream>
#include <limits>

#include <nlohmann/json.hpp>

#include "cli/cli_test_case.hpp"
#include "cli/town_files.hpp"

namespace d2b::test {
namespace {

const std::vector<std::string> building_fields{
    "id",      "ground", "roof",       "height",    "min_height", "p50",      "p70",
    "p90",     "p95",    "num_floors", "has_parts", "n_parts",    "n_levels", "n_points",
    "n_cells", "nodata", "confidence", "doubt",     "at_edge",    "area_m2",  "volume_m3",
    "perim_m", "status", "moved_m",    "area_chg"};
const std::vector<std::string> contour_fields{
    "id",        "parent_id", "bldg_id",    "level",   "threshold", "base",
    "top",       "height",    "min_height", "tier_z",  "n_points",  "elev_min",
    "elev_mean", "elev_max",  "confidence", "area_m2", "perim_m",   "status"};

/// Results without a building are whole all the same.
class Warnings : public CliTest {
  protected:
    void expect_layers(std::size_t buildings, std::size_t contours) const {
        EXPECT_EQ(layer_names(path("out.gpkg")), (std::vector<std::string>{"buildings", "contours"}));
        const Layer footprints = layer("out.gpkg", "buildings");
        const Layer stack = layer("out.gpkg", "contours");
        EXPECT_EQ(footprints.fields, building_fields);
        EXPECT_EQ(stack.fields, contour_fields);
        EXPECT_EQ(footprints.type, wkbMultiPolygon);
        EXPECT_EQ(footprints.records.size(), buildings);
        EXPECT_EQ(stack.records.size(), contours);
    }
    void warned(const RasterSpec& spec, const std::vector<std::string>& parts,
                Arguments arguments = {}) const {
        write(path("dem.tif"), spec);
        arguments.insert(arguments.end(), {"-q", "--", "dem.tif", "out.gpkg"});
        EXPECT_EQ(run_warned(arguments, parts), "");
    }
};

TEST_F(Warnings, ofRastersWithoutABuilding) {
    const auto raster = [](int rows, int cols, double z) {
        RasterSpec spec = blocks();
        spec.rows = rows;
        spec.cols = cols;
        spec.values.assign(static_cast<std::size_t>(rows * cols), z);
        spec.nodata = -9999;
        return spec;
    };
    RasterSpec row = raster(1, 30, 0);
    row.values[10] = row.values[11] = row.values[12] = 9;
    const std::string none_valid = "'dem.tif' has no valid point; the layers are empty.";
    const std::string flat = "All valid points of 'dem.tif' have the same elevation; no building was found.";
    const std::string nothing =
        "No building was found; a smaller -nf or -min_area, or more levels, may show some.";
    struct Case {
        RasterSpec spec;
        Arguments arguments;
        std::string warning;
        std::size_t contours;
    };
    for (const Case& one : std::vector<Case>{
             {raster(20, 30, -9999), {}, none_valid, 0},
             {raster(20, 30, 12.5), {}, flat, 1},
             {raster(1, 1, 7), {}, flat, 0},
             {row, {}, nothing, 0},  // points without area have no outline
             {blocks(), {"-nf", "1000", "-fl", "5"}, nothing, 1},
             {blocks(),
              {"-fl", "-5", "50"},
              "No threshold lies between the lowest and the highest elevation; no building was found.",
              1}}) {
        Arguments arguments = one.arguments;
        arguments.insert(arguments.begin(), "-overwrite");
        warned(one.spec, {one.warning}, arguments);
        expect_layers(0, one.contours);
    }
}

TEST_F(Warnings, ofCoarseCells) {
    RasterSpec spec = blocks();
    spec.transform = std::array<double, 6>{391000, 5, 0, 5820000, 0, -5};
    warned(spec, {"The cells are 5.0 m wide, which is too coarse for single buildings; up to 1 m is best"},
           {"-fl", "5"});
    expect_layers(2, 3);
    spec.transform = std::array<double, 6>{13, 0.0001, 0, 52, 0, -0.0001};
    spec.crs = "EPSG:4326";
    // sqrt(11.13 m x cos(52 degrees) x 11.13 m) = 8.7 m
    warned(spec, {"The cells are 8.7 m wide"}, {"-overwrite", "-fl", "5", "-inodata"});
}

TEST_F(Warnings, oneColumnInCells) {
    RasterSpec spec = blocks();
    spec.cols = 1;
    spec.rows = 30;
    spec.values.assign(30, 0);
    spec.values[10] = spec.values[11] = spec.values[12] = 9;
    write(path("dem.tif"), spec);
    run_well({"-q", "-trace", "cells", "-nf", "0", "-fl", "5", "--", "dem.tif", "out.gpkg"});
    expect_layers(1, 2);
    EXPECT_EQ(layer("out.gpkg", "buildings").records[0].area(), 3);
}

TEST_F(Warnings, noCrs) {
    RasterSpec spec = blocks();
    spec.crs = "";
    warned(spec,
           {"'dem.tif' has no coordinate reference system; lengths are taken as plain units; give it with "
            "-a_srs."},
           {"-fl", "5"});
    expect_layers(2, 3);
    EXPECT_EQ(layer("out.gpkg", "buildings").records[0].number("area_m2"), 63);
}

TEST_F(Warnings, noGeotransform) {
    RasterSpec spec = blocks();
    spec.transform.reset();
    spec.crs = "";
    warned(spec,
           {"'dem.tif' has no georeferencing; coordinates are columns and, upwards, rows.",
            "'dem.tif' has no coordinate reference system"},
           {"-fl", "5"});
    const OGREnvelope box = layer("out.gpkg", "buildings").records[0].box();
    EXPECT_EQ(box.MinX, 3.5);  // the centre of column 3
    EXPECT_EQ(box.MaxY, -3.5);
    EXPECT_EQ(box.MinY, -10.5);
}

TEST_F(Warnings, oneLayer) {
    write(path("dem.tif"), blocks());
    run_warned(
        {"-q", "-fl", "5", "--", "dem.tif", "out.geojson"},
        {R"("out.geojson" holds one layer; only the buildings are written; use -layers contours for the stack)"});
    EXPECT_EQ(layer("out.geojson", "out").records.size(), 2U);
}

TEST_F(Warnings, cutlineElsewhere) {
    write_text(path("area.geojson"),
               R"({"type": "Polygon", "coordinates": [[[1, 1], [2, 1], [2, 2], [1, 1]]]})");
    warned(blocks(),
           {"The cutline 'area.geojson' does not meet the part of 'dem.tif' that is used",
            "'dem.tif' has no valid point"},
           {"-cutline", "area.geojson"});
    expect_layers(0, 0);
}

using nlohmann::json;

/// Messages to users who give the wrong input, with the default preset.
class Diagnosis : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        preset_ = "";
    }
    void save(const std::string& name, std::vector<double> values) const {
        write(path(name), town_raster(std::move(values)));
    }
    void save_town() const { save("town.tif", MadeTown::surface()); }
    json dropped(Arguments arguments) const {
        arguments.insert(arguments.begin(), {"-json", "-overwrite"});
        const ToolResult result = run(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return json::parse(result.out)["dropped"];
    }
    [[nodiscard]] std::size_t buildings() const { return layer("out.gpkg", "buildings").records.size(); }
};

TEST_F(Diagnosis, optionsCountWhatTheyLeaveOut) {
    const std::string town = sample("town.tif");
    const json usual = dropped({town, "out.gpkg"});
    const std::size_t all = buildings();
    const json large = dropped({"-min_area", "500", town, "out.gpkg"});
    EXPECT_GE(large["building_small"].get<std::size_t>(), all - buildings());
    EXPECT_EQ(large["building_small"].get<std::size_t>(),
              all - buildings() + usual["building_small"].get<std::size_t>());
    const json high = dropped({"-min_height", "8", town, "out.gpkg"});
    EXPECT_GT(high["building_low"].get<std::size_t>(), usual["building_low"].get<std::size_t>());
    const json sure = dropped({"-min_confidence", "0.99", town, "out.gpkg"});
    EXPECT_EQ(sure["building_doubtful"].get<std::size_t>(), all - buildings());
    const std::string out = run_well({"-overwrite", "-min_area", "500", town, "out.gpkg"});
    EXPECT_NE(out.find(" in out.gpkg (left out: " + large["building_small"].dump() + " below -min_area"),
              std::string::npos)
        << out;
}

TEST_F(Diagnosis, areasOfShearedCellsAreThoseOnTheGround) {
    // Houses of 10 x 10 cells of 0.25 m2 on a grid whose rows are shifted by 100 cells each: 25 m2.
    RasterSpec spec =
        town_raster(MadeTown::in({{30, 30, 10, 10}, {30, 90, 10, 10}, {90, 60, 10, 10}}, 60, 50));
    spec.transform = std::array<double, 6>{391000, 0.5, 50, 5820000, 0, -0.5};
    write(path("sheared.tif"), spec);
    run_warned({"-q", "sheared.tif", "out.gpkg"}, {"No building was found: -min_area 30 leaves 3 out"});
    // Oblique shapes of that size keep their outlines as they were traced.
    run_warned({"-q", "-overwrite", "-min_area", "20", "sheared.tif", "out.gpkg"},
               {"keeps the staircase of the cells"});
    EXPECT_EQ(buildings(), 3U);
}

/// GDAL's driver prints its comments to stdout.
class Grib : public Diagnosis {
  protected:
    void SetUp() override {
        Diagnosis::SetUp();
        save_town();
        const OpenDataset town(GDALOpen(path("town.tif").c_str(), GA_ReadOnly));
        const GDALDriverH driver = GDALGetDriverByName("GRIB");
        if (driver == nullptr)
            GTEST_SKIP() << "this GDAL has no GRIB";
        GDALDatasetH copy =
            GDALCreateCopy(driver, path("town.grb2").c_str(), town.get(), FALSE, nullptr, nullptr, nullptr);
        ASSERT_NE(copy, nullptr);
        GDALClose(copy);
        std::ofstream(path("town.grb2"), std::ios::app) << "junk junk junk junk junk\n";
    }
};

TEST_F(Grib, stdoutIsTheReportAlone) {
    const ToolResult result = run({"-json", "town.grb2", "out.gpkg"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out.substr(0, 2), "{\n");
    EXPECT_EQ(json::parse(result.out)["output"]["buildings"], 3);
    EXPECT_NE(result.err, "") << "what the driver says is on stderr";
}

TEST_F(Grib, stdoutIsTheLayerAlone) {
    const ToolResult result = run({"-f", "GeoJSON", "-layers", "buildings", "town.grb2", "/vsistdout/"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(json::parse(result.out)["features"].size(), 3U);
}

}  // namespace
}  // namespace d2b::test
