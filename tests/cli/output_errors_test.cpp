#include <map>
#include <string>
#include <unistd.h>
#include <vector>

#include "cli/cli_test_case.hpp"

namespace d2b::test {
namespace {

class OutputErrors : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        write(path("dem.tif"), blocks());
    }
    void failed(int status, const std::string& part, const std::string& destination,
                Arguments arguments = {}) const {
        arguments.insert(arguments.end(), {"--", "dem.tif", destination});
        expect_error(status, part, arguments);
    }
    /// And nothing has been worked on before.
    void failed_at_once(const std::string& part, const std::string& destination,
                        Arguments arguments = {}) const {
        failed(1, part, destination, arguments);
        arguments.insert(arguments.end(), {"--", "dem.tif", destination});
        EXPECT_EQ(run(arguments).out, "");
    }
    static RasterSpec higher_blocks() {
        RasterSpec spec = blocks();
        for (double& value : spec.values)
            value += value > 0 ? 3 : 0;
        return spec;
    }
    /// Runs with a limit of the size of files, as a disk that fills up.
    ToolResult run_limited(int kilobytes, const Arguments& arguments) const {
        Arguments command{"sh", "-c", "ulimit -f " + std::to_string(kilobytes * 2) + "; exec \"$@\"", "sh",
                          D2B_TOOL};
        command.insert(command.end(), arguments.begin(), arguments.end());
        return run_tool(command, {.working_directory = folder_.string()});
    }
};

TEST_F(OutputErrors, destinationsThatCannotBe) {
    failed(1, R"(Cannot write "no/out.gpkg": no file can be created in "no" (No such file or directory))",
           "no/out.gpkg");
    failed(
        2,
        R"(Format "NoSuch" cannot hold a new vector dataset; -f takes, among others: GPKG, ESRI Shapefile)",
        "out.gpkg", {"-f", "NoSuch"});
}

TEST_F(OutputErrors, existingDestinations) {
    run_well({"-q", "dem.tif", "out.gpkg"});
    failed(2, R"("out.gpkg" exists; give -overwrite to replace the layers of this run in it, or -append)",
           "out.gpkg");
}

TEST_F(OutputErrors, aCrsThatTheFormatCannotHold) {
    const std::string rotated = "+proj=ob_tran +o_proj=longlat +o_lat_p=39.25 +o_lon_p=0 +lon_0=18";
    for (const std::string& crs : {std::string("+proj=igh_o +datum=WGS84"), rotated,
                                   std::string("+proj=peirce_q +lon_0=25 +shape=square")})
        failed(1,
               "Cannot write \"out.gpkg\": GPKG cannot hold the coordinate reference system '" + crs +
                   "' (PROJ: proj_as_wkt: ",
               "out.gpkg", {"-t_srs", crs});
    // GDAL 3.10 gives PROJ's reason, older ones lose the CRS in silence.
    for (const char* part :
         {"Cannot write \"out.shp\": ESRI Shapefile cannot hold the coordinate reference system '",
          "); choose another one with -t_srs, or another format."})
        failed(1, part, "out.shp", {"-t_srs", rotated, "-layers", "buildings"});
    EXPECT_EQ(run_warned({"-q", "-t_srs", "+proj=igh_o +datum=WGS84", "-layers", "buildings", "dem.tif",
                          "igh.geojson"},
                         {"GeoJSON cannot hold the coordinate reference system '+proj=igh_o +datum=WGS84': "
                          "programs will take "
                          "the coordinates of \"igh.geojson\" for 'WGS 84'; choose that one with -t_srs"}),
              "");
    failed(
        1, "Cannot write \"ground.tif\": GeoTIFF cannot hold the coordinate reference system '", "out.fgb",
        {"-preset", "buildings", "-a_srs", rotated, "-layers", "buildings", "-write_ground", "ground.tif"});
    run_well({"-q", "-t_srs", "+proj=igh_o +datum=WGS84", "-layers", "buildings", "dem.tif", "out.fgb"});
    run_well({"-q", "-t_srs", rotated, "-layers", "buildings", "dem.tif", "other.fgb"});
    run_well({"-q", "-t_srs", "EPSG:3857", "-layers", "buildings", "dem.tif", "out.geojson"});
    run_well({"-q", "-t_srs", "+proj=laea +lat_0=52 +lon_0=13", "dem.tif", "own.gpkg"});
}

TEST_F(OutputErrors, appendsNothingThatDoesNotFit) {
    run_well({"-q", "dem.tif", "out.gpkg"});
    failed_at_once(R"(has D2B_VERTICAL_UNIT "metre" and the result "foot"; write to another destination.)",
                   "out.gpkg", {"-append", "-zunit", "ft"});
    failed_at_once(R"(has D2B_CONTOURS "stacked" and the result "disjoint"; write to another destination.)",
                   "out.gpkg", {"-append", "-disjoint"});
}

TEST_F(OutputErrors, formatsThatTakeNoPolygonsOrGiveNoneBack) {
    failed_at_once("Cannot write \"out.map\": writing feature 1 of layer \"out\" failed (", "out.map",
                   {"-f", "WAsP", "-layers", "buildings"});
    for (const char* tiles : {"MVT", "PMTiles", "MBTiles"})
        if (GDALGetDriverByName(tiles) != nullptr &&
            GDALGetMetadataItem(GDALGetDriverByName(tiles), GDAL_DCAP_CREATE_LAYER, nullptr) != nullptr)
            failed(
                2,
                "\"out.tiles\" would hold tiles (format " + std::string(tiles) +
                    "), which cut polygons at their borders and move corners onto a coarse grid, so nothing "
                    "can be read back unchanged; write a GeoPackage, and make tiles of it with ogr2ogr.",
                "out.tiles", {"-f", tiles});
}

TEST_F(OutputErrors, creationOptionsThatFail) {
    failed(
        1,
        R"(; check whether -nln, -lco or -dsco ask for something impossible, or write another format, such as)",
        "out.shp", {"-layers", "buildings", "-lco", "SHPT=NONSENSE"});
    failed(2, "-lco GEOMETRY_NAME=id is the name of a field", "out.gpkg", {"-lco", "GEOMETRY_NAME=id"});
}

TEST_F(OutputErrors, fullDiskOnStdout) {
    const ToolSetup full{.stdout_file = "/dev/full"};
    const std::string sentence =
        "Cannot write to stdout; check whether the disk is full or the reader has gone.";
    expect_error(1, sentence, {"--help"}, full);
    expect_error(1, sentence, {"--version"}, full);
    expect_error(1, sentence, {"-f", "GeoJSON", "-layers", "buildings", "dem.tif", "/vsistdout/"}, full);
    // A report is a part of the result.
    preset_ = "";
    expect_error(1, sentence, {"-json", "dem.tif", "out.gpkg"}, full);
    expect_error(1, sentence, {"-sweep", "lod=2..3", "-preview", "sheet.png", "dem.tif"}, full);
    run_well({"-q", "-surface", "city.glb", "dem.tif", "out.gpkg"});
    write(path("dem.tif"), higher_blocks());
    expect_error(1, sentence, {"-overwrite", "-json", "-surface", "city.glb", "dem.tif", "out.gpkg"}, full);
    expect_error(1, sentence,
                 {"-overwrite", "-surface", "city.glb", "-f", "GeoJSON", "-layers", "buildings", "dem.tif",
                  "/vsistdout/"},
                 full);
}

/// A text about a result is no result.
TEST_F(OutputErrors, aSummaryThatIsLost) {
    const std::string warning = "Warning: The summary could not be written to stdout; the result is whole.\n";
    const auto whole = [&](const ToolResult& result, const std::string& said) {
        EXPECT_EQ(result.status, 0);
        EXPECT_EQ(result.err, said);
        EXPECT_EQ(layer("out.gpkg", "buildings").records.size(), 2U);
        std::filesystem::remove(path("out.gpkg"));
    };
    const auto in_shell = [&](const std::string& command, const Arguments& options) {
        Arguments all{"bash", "-c", command, "bash", D2B_TOOL, "-preset", "thesis"};
        all.insert(all.end(), options.begin(), options.end());
        return run_tool(all, {.working_directory = folder_.string()});
    };
    whole(run({"dem.tif", "out.gpkg"}, {.stdout_file = "/dev/full"}), warning);
    whole(run({"-q", "dem.tif", "out.gpkg"}, {.stdout_file = "/dev/full"}), "");
    whole(in_shell("exec \"$@\" >&-", {"dem.tif", "out.gpkg"}), warning);
    whole(in_shell("exec \"$@\" >&-", {"-q", "dem.tif", "out.gpkg"}), "");
    const std::string to_nobody = "\"$@\" | true; exit ${PIPESTATUS[0]}";
    whole(in_shell("sleep 0.2; " + to_nobody, {"dem.tif", "out.gpkg"}), warning);
    const ToolResult lost = in_shell(to_nobody, {"-json", "dem.tif", "out.gpkg"});
    EXPECT_EQ(lost.status, 1);
    EXPECT_FALSE(std::filesystem::exists(path("out.gpkg")));
    const ToolResult closed = in_shell("exec \"$@\" >&-", {"-json", "dem.tif", "out.gpkg"});
    EXPECT_EQ(closed.status, 1);
    EXPECT_EQ(entries(), (std::vector<std::string>{"dem.tif"}));
}

/// Whichever file does not fit, and whatever fitted before it.
TEST_F(OutputErrors, filesThatBelongTogether) {
    preset_ = "";
    const Arguments arguments{"-overwrite", "-q",       "-write_ground", "ground.tif", "-write_height",
                              "height.tif", "-surface", "city.glb",      "-surface",   "city.obj",
                              "-preview",   "map.svg",  "dem.tif",       "out.gpkg"};
    const auto content = [&] {
        std::map<std::string, std::string> all;
        for (const std::string& name : entries())
            all[name] = read_bytes(path(name));
        return all;
    };
    for (const bool replaces : {false, true}) {
        if (replaces)
            run_well(arguments);
        write(path("dem.tif"), higher_blocks());
        const auto old = content();
        int failed = 0;
        for (int kilobytes = 1; kilobytes < 200; kilobytes += kilobytes < 12 ? 1 : 20) {
            const ToolResult result = run_limited(kilobytes, arguments);
            if (result.status == 0)
                break;
            ++failed;
            EXPECT_EQ(result.status, 1) << kilobytes;
            EXPECT_TRUE(result.err.starts_with("ERROR: ")) << result.err;
            EXPECT_TRUE(content() == old) << kilobytes << " " << result.err;
        }
        EXPECT_GT(failed, 3);
        write(path("dem.tif"), blocks());
    }
}

}  // namespace
}  // namespace d2b::test
