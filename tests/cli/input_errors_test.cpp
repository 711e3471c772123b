#include <filesystem>
#include <regex>
#include <unistd.h>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <ogr_api.h>

#include "cli/cli_test_case.hpp"
#include "support/run_in_terminal.hpp"

namespace d2b::test {
namespace {

/// Errors are reported before the work: there is no progress yet.
class Messages : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        write(path("dem.tif"), blocks());
    }
    void refused(int status, const std::string& part, const Arguments& arguments) const {
        expect_error(status, part, arguments);
        EXPECT_EQ(run(arguments).out, "");
    }
    /// An archive with one file. @param prefix of GDAL's, e.g. "/vsizip/"
    void pack(const std::string& archive, const std::string& file, const std::string& bytes) const {
        write_text("/vsizip/" + path(archive) + "/" + file, bytes);
    }
};

TEST_F(Messages, swappedFileNames) {
    run_well({"-q", "dem.tif", "out.gpkg"});
    refused(1, "; it holds vector layers, and the program needs a raster of elevations.",
            {"-overwrite", "out.gpkg", "dem.tif"});
    refused(1, "'new.gpkg' cannot be opened as a raster: No such file or directory.",
            {"new.gpkg", "dem.tif"});
    refused(1, "'new.tif' cannot be opened as a raster: No such file or directory.", {"new.tif", "new.gpkg"});
    write_text(path("broken.tif"), "II*");
    refused(1, "'broken.tif' cannot be opened as a raster: ", {"broken.tif", "dem.tif"});
}

TEST_F(Messages, sourcesThatAreNoRasters) {
    const std::string points =
        "; it is a point cloud, so make a raster of its highest points first, for example with "
        "tools/points/highest_points.js of dem2buildings or with PDAL (writers.gdal).";
    write_text(path("scan.laz"), "LASF\x00\x00");
    write_text(path("scan"), "LASF and so on");
    write_text(path("SCAN.LAS"), "");
    for (const char* name : {"scan.laz", "scan", "SCAN.LAS"})
        refused(1, points, {name, "out.gpkg"});
    expect_error(1, "scan.laz' cannot be opened as a raster: ",
                 {"-preset", "buildings", "-ground", "scan.laz", "dem.tif", "out.gpkg"});
    run_well({"-q", "dem.tif", "town.gpkg"});
    refused(1, "; it holds vector layers, and the program needs a raster of elevations.",
            {"town.gpkg", "out.gpkg"});
}

TEST_F(Messages, archivesNameTheRasterInThem) {
    pack("one.zip", "dem.tif", read_bytes(path("dem.tif")));
    refused(1, "; it is an archive, so give the raster in it: /vsizip/one.zip.", {"one.zip", "out.gpkg"});
    run_well({"-q", "/vsizip/one.zip", "one.gpkg"});
    pack("two.zip", "a note.txt", "no raster");
    pack("two.zip", "data/dem.tif", read_bytes(path("dem.tif")));
    refused(1, "; it is an archive, so give the raster in it: /vsizip/two.zip/data/dem.tif.",
            {"two.zip", "out.gpkg"});
    run_well({"-q", "/vsizip/two.zip/data/dem.tif", "two.gpkg"});
    pack("none.zip", "note.txt", "no raster");
    refused(1, "; it is an archive without a raster that GDAL reads.", {"none.zip", "out.gpkg"});
}

TEST_F(Messages, aVrtIsNotDamagedWhereItsSourcesAreMissing) {
    const std::string vrt = R"(<VRTDataset rasterXSize="30" rasterYSize="20"><VRTRasterBand dataType="Float32"
        band="1"><SimpleSource><SourceFilename relativeToVRT="1">FILE</SourceFilename>
        <SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>)";
    for (const char* file : {"gone.tif", "itself.vrt"}) {
        write_text(path("itself.vrt"), std::regex_replace(vrt, std::regex("FILE"), file));
        const ToolResult result = run({"-q", "itself.vrt", "out.gpkg"});
        EXPECT_EQ(result.status, 1);
        expect_has(result.err, "cannot be read: ");
        expect_has(result.err, "; check whether the files and functions that the VRT names are there.");
    }
}

TEST_F(Messages, formatsThatCannotHoldTheLayers) {
    refused(2,
            "-f CityGML is not a format of layers; -surface writes CityJSON (.city.json), and citygml-tools "
            "from-cityjson makes CityGML of it.",
            {"-f", "CityGML", "dem.tif", "out.gml"});
    refused(
        2,
        "Surfaces are written as CityJSON, OBJ, STL or glTF; for CityGML write a .city.json, and convert it "
        "with citygml-tools from-cityjson.",
        {"-preset", "buildings", "-surface", "city.gml", "dem.tif", "out.gpkg"});
    refused(1, "Cannot write \"out.gpx\": creating layer \"out\" failed",
            {"-layers", "buildings", "dem.tif", "out.gpx"});
}

TEST_F(Messages, namesThatDatabasesKeepForThemselves) {
    for (const std::string name : {"layer_styles", "sqlite_master", "GPKG_contents", "rtree_buildings_geom"})
        refused(2, "-nln: a table \"" + name + "\" of a GPKG file is reserved; choose another name.",
                {"-layers", "buildings", "-nln", name, "dem.tif", "out.gpkg"});
    for (const std::string option : {"GEOMETRY_NAME=id", "geometry_name=Roof"})
        refused(2,
                "-lco " + option + " is the name of a field of the layer \"buildings\"; choose another name.",
                {"-lco", option, "dem.tif", "out.gpkg"});
    refused(1, "creating field \"height\" of layer \"buildings\" failed (Wrong field type for height); check",
            {"-lco", "FID=height", "dem.tif", "out.gpkg"});
    run_well(
        {"-q", "-lco", "FID=id", "-lco", "GEOMETRY_NAME=shape", "-nln", "styles", "dem.tif", "out.gpkg"});
    EXPECT_EQ(layer("out.gpkg", "styles").records.size(), 2U);
}

TEST_F(Messages, placesThatKeepNothing) {
    refused(2, "The destination '/vsimem/x.gpkg' is in memory and lost when the program ends; give a file.",
            {"dem.tif", "/vsimem/x.gpkg"});
    const std::string archive = "/vsizip/" + path("z.zip") + "/";
    const std::string rest =
        "\" is in an archive, which cannot be written to; give a file, and pack it afterwards.";
    refused(2, '"' + archive + "x.gpkg" + rest, {"dem.tif", archive + "x.gpkg"});
    refused(2, "\"/vsicurl/http://localhost/x.gpkg\" can only be read; give a file.",
            {"dem.tif", "/vsicurl/http://localhost/x.gpkg"});
    refused(2, "'/vsimem/g.png' is in memory", {"-preview", "/vsimem/g.png", "dem.tif", "out.gpkg"});
    refused(2, '"' + archive + "g.png" + rest, {"-preview", archive + "g.png", "dem.tif", "out.gpkg"});
}

TEST_F(Messages, fieldsThatAFormatWouldCut) {
    const std::string rest = ", which no other program would find; write a GeoPackage.";
    for (const auto& [fields, cut] :
         std::vector<std::pair<std::string, std::string>>{{"urock", "ROOF_HEIGH instead of ROOF_HEIGHT"},
                                                          {"city4cfd", "base_heigh instead of base_height"},
                                                          {"osm", "building_l instead of building:levels"}}) {
        refused(2, "-fields: \"out.shp\" would hold a field " + cut + rest,
                {"-layers", "buildings", "-fields", fields, "dem.tif", "out.shp"});
        refused(2, "-fields: \"folder\" would hold a field " + cut + rest,
                {"-f", "ESRI Shapefile", "-fields", fields, "dem.tif", "folder"});
        run_well({"-q", "-overwrite", "-fields", fields, "dem.tif", "out.gpkg"});
    }
}

TEST_F(Messages, bandsWhereTheFormatHoldsBuildingsAlone) {
    expect_error(2, "-disjoint has no effect if only buildings are written; use -layers contours, or",
                 {"-disjoint", "dem.tif", "out.geojson"}, {}, 1);
}

TEST_F(Messages, aLockedGeoPackage) {
    run_well({"-q", "dem.tif", "out.gpkg"});
    const GDALDatasetH other =
        GDALOpenEx(path("out.gpkg").c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE, nullptr, nullptr, nullptr);
    GDALDatasetExecuteSQL(other, "BEGIN IMMEDIATE", nullptr, nullptr);
    for (const char* flag : {"-overwrite", "-append"}) {
        const ToolResult result = run({flag, "dem.tif", "out.gpkg"});
        EXPECT_EQ(result.status, 1);
        EXPECT_EQ(result.out, "");
        expect_has(result.err,
                   "database is locked); another program is using it: close it there (in QGIS end editing "
                   "and remove its layers), then run again.");
    }
    GDALDatasetExecuteSQL(other, "ROLLBACK", nullptr, nullptr);
    GDALClose(other);
    run_well({"-q", "-overwrite", "dem.tif", "out.gpkg"});
}

TEST_F(Messages, aReadOnlyFile) {
    namespace fs = std::filesystem;
    Arguments command{D2B_TOOL};
    if (::geteuid() == 0) {  // who may write all the same
        command = {"/usr/bin/setpriv", "--reuid=65534", "--clear-groups", D2B_TOOL};
        if (!fs::exists(command[0]) ||
            run_tool({command[0], "--reuid=65534", "--clear-groups", D2B_TOOL, "--version"}).status != 0)
            GTEST_SKIP() << "root may write, and nobody else may run the program";
    }
    run_well({"-q", "dem.tif", "out.gpkg"});
    run_well({"-q", "-layers", "buildings", "dem.tif", "out.fgb"});
    fs::permissions(folder_, fs::perms::all);
    for (const char* name : {"out.gpkg", "out.fgb"}) {
        fs::permissions(path(name), fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read);
        Arguments arguments = command;
        arguments.insert(arguments.end(), {"-layers", "buildings", "-overwrite", "dem.tif", name});
        const ToolResult result = run_tool(arguments, {.working_directory = folder_.string()});
        EXPECT_EQ(result.status, 1);
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(result.err, std::string("ERROR: Cannot write \"") + name +
                                  "\": it is read-only (Permission denied); allow writing, or choose another "
                                  "destination.\n");
    }
}

TEST_F(Messages, notesOfGdalNameTheUsersFileAndComeOnce) {
    run_warned({"-q", "-lco", "FOO=1", "dem.tif", "out.gpkg"},
               {"GDAL: dataset out.gpkg does not support layer creation option FOO."});
    const ToolResult result = run({"/vsistdin/", "out2.gpkg"}, {.stdin_text = "no raster"});
    // GDAL 3.10 has other words for it.
    EXPECT_TRUE(std::regex_match(
        result.err,
        std::regex("ERROR: '/vsistdin/' cannot be opened as a raster: `/vsistdin/' not recognized as "
                   "(a|being in a) supported file format\\.\n")))
        << result.err;
}

TEST_F(Messages, inATerminalAWarningBeginsALine) {
    const std::string shown =
        run_in_terminal({D2B_TOOL, "-preset", "thesis", "-min_area", "1e9", sample("town.tif"), "out.gpkg"},
                        folder_.string());
    EXPECT_TRUE(std::regex_search(
        shown, std::regex("[0-9.]+\nWarning: No building was found; [^\n]*\n[.0-9]+ - done.\n")))
        << shown;
    std::string progress = shown;
    progress.erase(progress.find("\nWarning"),
                   progress.find(".\n", progress.find("\nWarning")) + 2 - progress.find("\nWarning"));
    EXPECT_TRUE(progress.starts_with("0...10...20...30...40...50...60...70...80...90...100 - done.\n"))
        << progress;
    // Elsewhere than in a terminal progress is one line.
    const ToolResult piped = run({"-preset", "thesis", "-min_area", "1e9", sample("town.tif"), "two.gpkg"});
    EXPECT_TRUE(piped.out.starts_with("0...10...20...30...40...50...60...70...80...90...100 - done.\n"));
}

class InputErrors : public CliTest {
  protected:
    void failed(const std::string& part, const std::string& source, Arguments arguments = {}) const {
        arguments.insert(arguments.end(), {"--", source, "out.gpkg"});
        expect_error(1, part, arguments);
    }
};

TEST_F(InputErrors, missingSource) {
    failed("'none.tif' cannot be opened as a raster: ", "none.tif");
    failed("'nowhere/none.tif' cannot be opened as a raster: ", "nowhere/none.tif");
    failed("'/vsizip/none.zip/a.tif' cannot be opened as a raster: ", "/vsizip/none.zip/a.tif");
}

TEST_F(InputErrors, notARaster) {
    write_text(path("text.tif"), "no raster at all");
    failed("'text.tif' cannot be opened as a raster: ", "text.tif");
    write_text(path("empty.tif"), "");
    failed("'empty.tif' cannot be opened as a raster: ", "empty.tif");
}

TEST_F(InputErrors, truncatedCompressedTown) {
    const std::string bytes = read_bytes(sample("town.tif"));
    write_text(path("short.tif"), bytes.substr(0, bytes.size() * 2 / 3));
    failed("short.tif' cannot be ", "short.tif");
}

TEST_F(InputErrors, targetsThatTearTheDemApart) {
    RasterSpec spec = blocks();
    spec.crs = "EPSG:4326";
    spec.transform = std::array<double, 6>{179.9999, 1e-5, 0, -17, 0, -1e-5};
    write(path("fiji.tif"), spec);
    failed("'fiji.tif' cannot be converted to 'WGS 84 / Pseudo-Mercator', which splits the area", "fiji.tif",
           {"-t_srs", "EPSG:3857"});
    run_well({"-q", "-t_srs", "EPSG:32760", "fiji.tif", "fiji.gpkg"});
}

TEST_F(InputErrors, aCrsOfHeights) {
    write(path("dem.tif"), blocks());
    expect_error(2, "'EGM96 height' has no plane coordinates to transform to",
                 {"-t_srs", "EPSG:5773", "dem.tif", "out.gpkg"});
}

TEST_F(InputErrors, stdinWithoutRoom) {
    const Arguments arguments{"--config", "CPL_TMPDIR=/nonexistent", "/vsistdin/", "out.gpkg"};
    expect_error(1, "set CPL_TMPDIR to a folder with room.", arguments,
                 {.stdin_text = read_bytes(sample("degrees.tif"))});
}

}  // namespace
}  // namespace d2b::test
