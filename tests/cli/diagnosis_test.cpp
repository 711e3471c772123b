#include <cmath>
#include <fstream>
#include <limits>

#include <nlohmann/json.hpp>

#include "cli/cli_test_case.hpp"
#include "cli/town_files.hpp"

namespace d2b::test {
namespace {

using nlohmann::json;

/// What a user is told who gives the wrong thing, with the default preset.
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

TEST_F(Diagnosis, noAreaIsTooLarge) {
    save_town();
    for (const char* area : {"1e18", "1e19", "1e308"})
        run_warned({"-q", "-overwrite", "-min_area", area, "town.tif", "out.gpkg"},
                   {"No building was found: -min_area "});
    EXPECT_EQ(buildings(), 0U);
}

TEST_F(Diagnosis, areasOfShearedCellsAreThoseOnTheGround) {
    // Houses of 10 x 10 cells of 0.25 m2 on a grid whose rows are shifted by 100 cells each: 25 m2.
    RasterSpec spec =
        town_raster(MadeTown::in({{30, 30, 10, 10}, {30, 90, 10, 10}, {90, 60, 10, 10}}, 60, 50));
    spec.transform = std::array<double, 6>{391000, 0.5, 50, 5820000, 0, -0.5};
    write(path("sheared.tif"), spec);
    run_warned({"-q", "sheared.tif", "out.gpkg"}, {"No building was found: -min_area 30 leaves 3 out"});
    // What is that oblique keeps its outlines as they were traced.
    run_warned({"-q", "-overwrite", "-min_area", "20", "sheared.tif", "out.gpkg"},
               {"keeps the staircase of the cells"});
    EXPECT_EQ(buildings(), 3U);
}

TEST_F(Diagnosis, aSideThatSaysNothing) {
    save_town();
    RasterSpec nothing = town_raster(MadeTown::in({}, 0, -9999));
    nothing.nodata = -9999;
    write(path("nothing.tif"), nothing);
    const Arguments rest{"-q", "-overwrite", "town.tif", "out.gpkg"};
    const auto with = [&](const char* option) {
        Arguments arguments{option, "nothing.tif"};
        arguments.insert(arguments.end(), rest.begin(), rest.end());
        return arguments;
    };
    run_warned(with("-ground"),
               {"No building was found: the terrain 'nothing.tif' has no valid cell over the DEM"});
    run_warned(with("-mask"),
               {"No building was found: the mask 'nothing.tif' has no cell over the DEM that is "
                "neither 0 nor NoData"});
    run_warned(with("-ndvi"), {"The NDVI 'nothing.tif' has no valid cell over the DEM"});
    EXPECT_EQ(buildings(), 3U);
}

TEST_F(Diagnosis, aGroundThatDoesNotFit) {
    save_town();
    for (const double by : {-43.0, 43.0}) {
        std::vector<double> terrain = MadeTown::terrain();
        for (double& z : terrain)
            z += by;
        save("dtm.tif", terrain);
        run_warned({"-q", "-overwrite", "-ground", "dtm.tif", "town.tif", "out.gpkg"},
                   {by < 0 ? "Only 0 % of the cells lie within 2 m of the terrain 'dtm.tif'"
                           : "No building was found: the terrain 'dtm.tif' lies 43 m above the surface"});
    }
    run_warned({"-q", "-overwrite", "-ground", "none", "town.tif", "out.gpkg"},
               {"-ground none takes elevations as heights above the ground, and their median is 10"});
}

TEST_F(Diagnosis, aTerrainModelOrAPicture) {
    save("dtm.tif", MadeTown::terrain());
    run_warned(
        {"-q", "dtm.tif", "out.gpkg"},
        {"No building was found: none of the cells of 'dtm.tif' rise by more than 2 m above their "
         "surroundings, as in a terrain model (DTM), which has no buildings; give the surface model (DSM)."});
    RasterSpec picture = town_raster(MadeTown::in({MadeTown::wood}, 101, 100));
    picture.type = GDT_Byte;
    picture.bands = 3;
    write(path("photo.tif"), picture);
    run_warned(
        {"-q", "-overwrite", "photo.tif", "out.gpkg"},
        {"No building was found: 'photo.tif' has 3 bands of byte values, like a picture; give a surface "
         "model (DSM), or choose the band of its elevations with -b."});
}

TEST_F(Diagnosis, degreesThatNothingSaysAreDegrees) {
    RasterSpec spec = town_raster(MadeTown::surface());
    spec.crs = "";
    spec.transform = std::array<double, 6>{13, 1.5e-5, 0, 52, 0, -1e-5};
    write(path("dem.tif"), spec);
    run_warned({"-q", "dem.tif", "out.gpkg"}, {"'dem.tif' has no coordinate reference system",
                                               "No building was found: 'dem.tif' has no CRS"});
    run_well({"-q", "-overwrite", "-a_srs", "EPSG:4326", "dem.tif", "out.gpkg"});  // as it advises
    EXPECT_EQ(buildings(), 3U);
}

TEST_F(Diagnosis, aBarePlaneHasNoBuilding) {
    std::vector<double> z;
    for (int r = 0; r < MadeTown::rows; ++r)
        for (int c = 0; c < MadeTown::cols; ++c)
            z.push_back(100 + 0.6 * c);
    save("plane.tif", z);
    const ToolResult result = run({"-q", "-write_doubtful", "plane.tif", "out.gpkg"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(buildings(), 0U);
    for (const Record& record : layer("out.gpkg", "doubtful").records) {
        EXPECT_EQ(record.number("confidence"), 0);
        EXPECT_EQ(record.text("doubt"), "no step at its border");
    }
}

/// GDAL's driver says on stdout what it thinks of it.
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
