#include <cmath>

#include "cli/cli_test_case.hpp"
#include "cli/town_files.hpp"

namespace d2b::test {
namespace {

class OptionErrors : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        write(path("dem.tif"), blocks());
    }
    /// Wrong usage: status 2. The file names follow the arguments.
    void refused(Arguments arguments, const std::string& part) const {
        arguments.insert(arguments.end(), {"--", "dem.tif", "out.gpkg"});
        expect_error(2, part, arguments);
    }
};

TEST_F(OptionErrors, printsTheUsageWhereThereAreNoArguments) {
    const ToolResult result = run({});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err,
              "Usage: dem2buildings [options] <src_raster>... <dst_vector>\n"
              "Try dem2buildings --help for the options.\n");
}

TEST_F(OptionErrors, refusesUnknownOptionsWithAdvice) {
    refused({"-lad", "4"}, "There is no option -lad; did you mean -lod?");
    refused({"-nonsense"}, "There is no option -nonsense; dem2buildings --help_all lists all.");
    refused({"-config", "A", "B"}, "There is no option -config; did you mean --config?");
}

TEST_F(OptionErrors, refusesWhatTheTableRefuses) {
    refused({"-lod", "2.5"}, "-lod must be a whole number from 1 to 10000, not '2.5'.");
    refused({"-lod", "3", "-lod", "4"}, "-lod is given twice; give it once.");
    refused({"-overwrite", "-append"}, "-overwrite cannot be used together with -append");
    expect_error(2, "The destination is missing, there is only 'dem.tif'", {"dem.tif"});
    expect_error(2, "-json cannot be used with a destination in /vsistdout/",
                 {"-json", "-f", "GeoJSON", "dem.tif", "/vsistdout/"});
}

TEST_F(OptionErrors, refusesWhatDoesNotFitTheInput) {
    refused({"-srcwin", "25", "0", "6", "5"}, "does not lie inside the raster; the raster has 30 columns");
    refused({"-i", "1e-6"}, "-i 1e-06 gives more than 65534 levels on this DEM; use a larger interval.");
    refused({"-t_srs", "EPSG:nothing"}, "EPSG:nothing");
    refused({"-t_srs", "4326"},
            "'4326' is not a coordinate reference system; write EPSG:4326 if that is meant.");
}

TEST_F(OptionErrors, saysInWhichOrderCornersCome) {
    refused({"-te", "0", "5", "4", "1"},
            "-te takes xmin ymin xmax ymax, and 0 5 4 1 is the upper left and the lower right corner, as "
            "-projwin takes them; write -te 0 1 4 5.");
    refused({"-te", "5819990", "391002", "5819999", "391010"},
            "; x comes before y, so write -te 391002 5819990 391010 5819999.");
}

TEST_F(OptionErrors, refusesToReprojectWhatHasNoCrs) {
    RasterSpec spec = blocks();
    spec.crs = "";
    write(path("plain.tif"), spec);
    expect_error(2, "-t_srs needs to know the CRS of the DEM, which has none; give it with -a_srs.",
                 {"-t_srs", "EPSG:4326", "plain.tif", "out.gpkg"}, {}, 1);
}

/// Errors of the preset buildings.
class BuildingErrors : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        preset_ = "buildings";
        write(path("dem.tif"), town_raster(MadeTown::surface()));
    }
    void refused(int status, Arguments arguments, const std::string& part, int warnings = 0) const {
        arguments.insert(arguments.end(), {"--", "dem.tif", "out.gpkg"});
        expect_error(status, part, arguments, {}, warnings);
    }
};

TEST_F(BuildingErrors, refusesADoubtfulLayerWhereThereIsNoPlace) {
    expect_error(2, "\"out.geojson\" holds one layer (format GeoJSON); use a GeoPackage for -write_doubtful.",
                 {"-write_doubtful", "dem.tif", "out.geojson"});
    expect_error(2, "\"out.geojson\" holds one layer (format GeoJSON); use a GeoPackage for -write_rejected.",
                 {"-write_rejected", "dem.tif", "out.geojson"});
    expect_error(2, "\"out.geojson\" holds one layer (format GeoJSON); use a GeoPackage for -roofs.",
                 {"-roofs", "dem.tif", "out.geojson"});
}

TEST_F(BuildingErrors, refusesToOverwriteWhatItReadsOrWrites) {
    write(path("dtm.tif"), town_raster(MadeTown::terrain()));
    for (const char* option : {"-write_ground", "-write_height", "-write_canopy"}) {
        refused(2, {"-overwrite", option, "dem.tif"},
                "\"dem.tif\" is already read or written by this run; choose another name.");
        refused(2, {"-overwrite", "-ground", "dtm.tif", option, "./dtm.tif"},
                "\"./dtm.tif\" is already read or written by this run; choose another name.");
        refused(2, {option, "dtm.tif"},
                "\"dtm.tif\" exists; give another name, or -overwrite to replace it.");
        refused(2, {option, "out.png"},
                "Rasters are written as GeoTIFF; give \"out.png\" a name that ends in .tif.");
        refused(1, {option, "no/such/g.tif"}, "no file can be created in \"no/such\" (");
    }
    refused(2, {"-write_ground", "a.tif", "-write_height", "a.tif"},
            "\"a.tif\" is already read or written by this run; choose another name.");
}

}  // namespace
}  // namespace d2b::test
