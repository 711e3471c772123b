#include <fstream>

#include <nlohmann/json.hpp>

#include "cli/cli_test_case.hpp"

namespace d2b::test {
namespace {

using nlohmann::json;

/// Runs dem2buildings_tiles in an empty folder of its own.
class TilesTool : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        preset_ = "";
    }
    [[nodiscard]] ToolResult tiles(const Arguments& arguments, const std::optional<Kill>& kill = {},
                                   const std::string& stdout_file = "") const {
        Arguments command{D2B_TILES_TOOL};
        command.insert(command.end(), arguments.begin(), arguments.end());
        ToolSetup setup;
        setup.working_directory = folder_.string();
        setup.environment = {date_};
        setup.kill = kill;
        setup.stdout_file = stdout_file;
        return run_tool(command, setup);
    }
    std::string well(const Arguments& arguments) const {
        const ToolResult result = tiles(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(result.err, "");
        return result.out;
    }
    /// All steps of a plan of one tile, up to the result.
    void run_steps() const {
        for (const Arguments& step : {Arguments{"find", "work", "0"},
                                      {"join", "work"},
                                      {"draw", "work", "0"},
                                      {"merge", "-q", "work"}})
            well(step);
    }
    void expect_refused(int status, const std::string& message, const Arguments& arguments) const {
        const std::vector<std::string> before = entries();
        const ToolResult result = tiles(arguments);
        EXPECT_EQ(result.status, status);
        EXPECT_EQ(result.err, "ERROR: " + message + "\n");
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(entries(), before);
    }
    /// Water around a hall of the town, a cut through four blocks and a point on a house.
    void write_decisions() const {
        const auto write = [&](const std::string& name, const std::string& features) {
            std::ofstream(path(name)) << R"({"type": "FeatureCollection", "crs": {"type": "name", )"
                                      << R"("properties": {"name": "urn:ogc:def:crs:EPSG::25833"}}, )"
                                      << R"("features": [)" << features << "]}";
        };
        const auto feature = [](const std::string& kind, const std::string& type, const std::string& places) {
            return R"({"type": "Feature", "properties": {"kind": ")" + kind +
                   R"("}, "geometry": {"type": ")" + type + R"(", "coordinates": )" + places + "}}";
        };
        write("bridges.geojson",
              feature("", "Polygon",
                      "[[[391140, 5820090], [391300, 5820090], [391300, 5820180], [391140, 5820180], "
                      "[391140, 5820090]]]"));
        write("edits.geojson", feature("cut", "LineString", "[[391300, 5820350], [391700, 5820351]]") + "," +
                                   feature("building", "Point", "[391372.8, 5820958.6]"));
    }
    /// The report without values that differ from run to run.
    [[nodiscard]] static json facts(const std::string& report) {
        json all = json::parse(report);
        for (const char* key : {"stages", "threads", "output"})
            all.erase(key);
        return all;
    }
    std::string whole(const Arguments& options, const std::string& file) const {
        Arguments arguments = options;
        arguments.insert(arguments.end(), {"-json", sample("town.tif"), file});
        return run_well(arguments, {.environment = {date_}});
    }

    const std::string date_ = "OGR_CURRENT_DATE=2001-02-03T04:05:06.000Z";
};

TEST_F(TilesTool, givesTheBytesOfOneRun) {
    const std::vector<Arguments> variants{
        {},
        {"-write_doubtful", "-split_height", "3", "-disjoint"},
        {"-t_srs", "EPSG:4326", "-3d", "-nf", "12"},
        {"-t_srs", "EPSG:4326", "-roofs", "-fields", "osm"},
        {"-split_by", sample("town_parcels.gpkg"), "-split_field", "parcel", "-roofs"},
        {"-exclude", "bridges.geojson", "-exclude_buffer", "2", "-corrections", "edits.geojson",
         "-storey_height", "4"},
        {"-footprints", sample("town_parcels.gpkg"), "-roofs"}};
    write_decisions();
    for (const Arguments& options : variants) {
        const std::string report = whole(options, "one.gpkg");
        Arguments plan{"plan"};
        plan.insert(plan.end(), options.begin(), options.end());
        plan.insert(plan.end(), {sample("town.tif"), "tiles.gpkg", "work"});
        EXPECT_TRUE(well(plan).starts_with("1 tile in work. With one thread a tile takes "));
        well({"find", "work", "0"});
        well({"join", "work"});
        well({"draw", "work", "0"});
        const std::string merged = well({"merge", "-json", "work"});
        json expected = facts(report);
        json got = facts(merged);
        EXPECT_EQ(got, expected);
        EXPECT_TRUE(read_bytes(path("tiles.gpkg")) == read_bytes(path("one.gpkg")));
        for (const char* name : {"work", "tiles.gpkg", "one.gpkg"})
            std::filesystem::remove_all(path(name));
    }
}

/// A format of one layer has the footprints alone.
TEST_F(TilesTool, measuresFootprintsForOneLayer) {
    const Arguments options{"-footprints", sample("town_parcels.gpkg"), "-layers", "buildings", "-nln",
                            "given",       sample("town.tif")};
    Arguments one = options;
    one.insert(one.begin(), "-q");
    one.emplace_back("one.geojson");
    run_well(one);
    Arguments plan = options;
    plan.insert(plan.begin(), "plan");
    plan.insert(plan.end(), {"tiles.geojson", "work"});
    well(plan);
    run_steps();
    EXPECT_TRUE(read_bytes(path("tiles.geojson")) == read_bytes(path("one.geojson")));
}

TEST_F(TilesTool, writesFootprintsIntoTheirFile) {
    for (const char* name : {"one.gpkg", "tiles.gpkg"})
        std::filesystem::copy_file(sample("town_parcels.gpkg"), path(name));
    const auto given = [&](const std::string& name) {
        return Arguments{"-footprints", name,       "-footprints_layer", "parcels", "-overwrite",
                         "-nln",        "measured", sample("town.tif"),  name};
    };
    Arguments one = given("one.gpkg");
    one.insert(one.begin(), "-q");
    run_well(one);
    Arguments plan = given("tiles.gpkg");
    plan.insert(plan.begin(), "plan");
    plan.emplace_back("work");
    well(plan);
    run_steps();
    EXPECT_EQ(layer_names(path("tiles.gpkg")), layer_names(path("one.gpkg")));
    EXPECT_EQ(read_layer(path("tiles.gpkg"), "parcels").records.size(), 1014U);
    for (const std::string sum : {"count(*)", "sum(p90)", "sum(volume_m3)", "sum(rowid * n_parts)"}) {
        const std::string query = "SELECT " + sum + " FROM measured";
        EXPECT_EQ(sql_value(path("tiles.gpkg"), query), sql_value(path("one.gpkg"), query));
        EXPECT_NE(sql_value(path("one.gpkg"), query), "");
    }
}

/// Faces are added behind those of another run, with the ids of their buildings there.
TEST_F(TilesTool, addsRoofsToThoseThatAreThere) {
    const auto quarter = [&](const std::string& west, const std::string& east, const Arguments& more) {
        Arguments arguments{"-q", "-roofs", "-split_height", "3", "-te", west, "5820100", east, "5820300"};
        arguments.push_back(sample("town.tif"));
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    };
    for (const char* name : {"one.gpkg", "tiles.gpkg"})
        run_well(quarter("391100", "391300", {name}), {.environment = {date_}});
    run_well(quarter("391300", "391500", {"-append", "one.gpkg"}), {.environment = {date_}});
    Arguments plan = quarter("391300", "391500", {"-append", "tiles.gpkg", "work"});
    plan.insert(plan.begin(), "plan");
    well(plan);
    run_steps();
    EXPECT_TRUE(read_bytes(path("tiles.gpkg")) == read_bytes(path("one.gpkg")));
}

TEST_F(TilesTool, writesRoofsIntoFilesOfOneLayer) {
    const Arguments folder{"-q", "-roofs", "-f", "ESRI Shapefile", sample("town.tif")};
    Arguments one = folder;
    one.emplace_back("one");
    run_well(one);
    Arguments plan = folder;
    plan.insert(plan.begin(), "plan");
    plan.insert(plan.end(), {"tiles", "work"});
    well(plan);
    run_steps();
    for (const char* layer : {"buildings", "contours", "roofs"})
        for (const char* kind : {".shp", ".shx"})
            EXPECT_TRUE(read_bytes(path("tiles/" + std::string(layer) + kind)) ==
                        read_bytes(path("one/" + std::string(layer) + kind)))
                << layer << kind;
}

/// A report is a part of the result: merge can be run again.
TEST_F(TilesTool, aReportThatIsLost) {
    for (const Arguments& destination : {Arguments{"tiles.gpkg"}, Arguments{"-f", "FlatGeobuf", "tiles"}}) {
        Arguments plan{"plan", "-q", "-te", "391100", "5820100", "391400", "5820300", sample("town.tif")};
        plan.insert(plan.end(), destination.begin(), destination.end());
        plan.emplace_back("work");
        well(plan);
        for (const Arguments& step :
             {Arguments{"find", "work", "0"}, Arguments{"join", "work"}, Arguments{"draw", "work", "0"}})
            well(step);
        const std::vector<std::string> before = entries();
        const ToolResult lost = tiles({"merge", "-json", "work"}, {}, "/dev/full");
        EXPECT_EQ(lost.status, 1);
        EXPECT_EQ(lost.err,
                  "ERROR: Cannot write to stdout; check whether the disk is full or the reader has gone.\n");
        if (destination.size() == 1) {
            EXPECT_EQ(entries(), before);
        }
        EXPECT_TRUE(well({"merge", "-json", "work"}).starts_with("{"));
        for (const char* name : {"work", "tiles.gpkg", "tiles"})
            std::filesystem::remove_all(path(name));
    }
    well({"plan", "-q", sample("town.tif"), "tiles.gpkg", "work"});
    for (const Arguments& step :
         {Arguments{"find", "work", "0"}, Arguments{"join", "work"}, Arguments{"draw", "work", "0"}})
        well(step);
    const ToolResult told = tiles({"merge", "work"}, {}, "/dev/full");
    EXPECT_EQ(told.status, 0);
    EXPECT_EQ(told.err, "Warning: The summary could not be written to stdout; the result is whole.\n");
    EXPECT_TRUE(std::filesystem::exists(path("tiles.gpkg")));
}

TEST_F(TilesTool, readsAListOfRasters) {
    const auto cut = [&](const std::string& name, const Arguments& window) {
        Arguments command{"gdal_translate", "-q", "-srcwin"};
        command.insert(command.end(), window.begin(), window.end());
        command.insert(command.end(), {sample("town.tif"), path(name)});
        ASSERT_EQ(run_tool(command, {}).status, 0);
    };
    cut("west.tif", {"300", "300", "150", "200"});
    cut("east.tif", {"450", "300", "250", "200"});
    std::ofstream(path("list.txt")) << "west.tif\n\neast.tif\n";
    const Arguments plan{"plan", "-q", "-input_file_list", "list.txt", "tiles.gpkg", "work"};
    well(plan);
    const std::string made = read_bytes(path("work/plan.json"));
    for (const char* name : {"west.tif", "east.tif", "work/source.vrt"})
        EXPECT_NE(made.find(std::string("\"name\": \"") + name), std::string::npos) << made;
    well(plan);  // once more, which changes nothing
    EXPECT_EQ(read_bytes(path("work/plan.json")), made);
    run_steps();
    run_well({"-q", "work/source.vrt", "one.gpkg"}, {.environment = {date_}});
    EXPECT_TRUE(read_bytes(path("tiles.gpkg")) == read_bytes(path("one.gpkg")));
    cut("both.tif", {"300", "300", "400", "200"});
    run_well({"-q", "-layers", "buildings", "both.tif", "both.csv"});
    run_well({"-q", "-layers", "buildings", "work/source.vrt", "mosaic.csv"});
    EXPECT_TRUE(read_bytes(path("mosaic.csv")) == read_bytes(path("both.csv")));
    std::ofstream(path("east.tif"), std::ios::app | std::ios::binary) << "more";
    expect_refused(1, "'east.tif' has changed since the plan was made; plan again, with a new work folder.",
                   {"find", "work", "0"});
}

TEST_F(TilesTool, leavesNothingOfListsThatItRefuses) {
    std::ofstream(path("list.txt")) << "nothing.tif\n";
    const auto plan = [](const std::string& list, const std::string& destination, const std::string& work) {
        return Arguments{"plan", "-q", "-input_file_list", list, destination, work};
    };
    expect_refused(1, "'nothing.tif' cannot be opened as a raster: No such file or directory.",
                   plan("list.txt", "a.gpkg", "work"));
    expect_refused(1,
                   "'none.txt' cannot be read: No such file or directory; give a text file with one raster "
                   "name per line.",
                   plan("none.txt", "a.gpkg", "work"));
    std::ofstream(path("empty.txt")) << "\n";
    expect_refused(1, "'empty.txt' names no raster; write one raster name per line.",
                   plan("empty.txt", "a.gpkg", "work"));
    std::ofstream(path("town.txt")) << sample("town.tif") << '\n';
    std::ofstream(path("file")) << "no folder";
    expect_refused(1, "'file' cannot be written to: Not a directory; give another work folder.",
                   plan("town.txt", "a.gpkg", "file"));
    expect_refused(1, "'file' cannot be written to: Not a directory; give another work folder.",
                   {"plan", "-q", sample("town.tif"), "a.gpkg", "file"});
    // The mosaic was made by then.
    std::ofstream(path("a.gpkg")) << "not a database";
    const std::vector<std::string> before = entries();
    EXPECT_EQ(tiles(plan("town.txt", "a.gpkg", "work")).status, 2);
    EXPECT_EQ(entries(), before);
    // The mosaic of a plan stays that of the plan.
    well(plan("town.txt", "b.gpkg", "work"));
    std::filesystem::copy(sample("town.tif"), path("copy.tif"));
    std::ofstream(path("town.txt")) << "copy.tif\n";
    const std::string mosaic = read_bytes(path("work/source.vrt"));
    expect_refused(2,
                   "'work' holds another plan, or the plan of a source that has changed; give another work "
                   "folder, or delete this one.",
                   plan("town.txt", "b.gpkg", "work"));
    EXPECT_EQ(read_bytes(path("work/source.vrt")), mosaic);
}

TEST_F(TilesTool, writesPartsWithTheNumbersOfOneRun) {
    run_well({"-q", "-roofs", "-f", "FlatGeobuf", sample("town.tif"), "one"});
    well({"plan", "-q", "-roofs", "-f", "FlatGeobuf", sample("town.tif"), "parts", "work"});
    well({"find", "work", "0"});
    well({"join", "work"});
    well({"draw", "work", "0"});
    EXPECT_NE(well({"merge", "work"}).find(" faces of roofs in parts"), std::string::npos);
    EXPECT_EQ(well({"merge", "work"}), "");  // it has been done
    EXPECT_FALSE(std::filesystem::exists(path("parts")));
    for (int time = 0; time < 2; ++time) {
        well({"write", "work", "0"});
        for (const std::string layer : {"buildings", "contours", "roofs"}) {
            EXPECT_TRUE(read_bytes(path("parts/" + layer + "/0.fgb")) ==
                        read_bytes(path("one/" + layer + ".fgb")));
            const std::string mosaic = read_bytes(path("parts/" + layer + ".vrt"));
            EXPECT_NE(mosaic.find(">" + layer + "/0.fgb</SrcDataSource>"), std::string::npos) << mosaic;
        }
    }
    std::filesystem::remove(path("work/merge/0"));
    std::filesystem::remove(path("work/write/0"));
    expect_refused(
        1, "'" + path("work") + "/merge/0' cannot be read: No such file or directory; run 'merge' first.",
        {"write", "work", "0"});
    expect_refused(2,
                   "The folder to which tiles add their files must be new; give another name, or delete it, "
                   "and leave out -append and -overwrite.",
                   {"plan", "-overwrite", "-f", "FlatGeobuf", sample("town.tif"), "parts", "again"});
}

/// A mosaic finds its parts by the bytes of their names.
TEST_F(TilesTool, writesPartsUnderNamesThatAreNotUtf8) {
    const std::string name = "ground_\xE4";
    run_well({"-q", "-write_ground", "ground.tif", sample("town.tif"), "one.gpkg"});
    well({"plan", "-q", "-write_ground", name + ".vrt", sample("town.tif"), "parts.gpkg", "work"});
    run_steps();
    run_well({"-q", "-ground", "ground.tif", sample("town.tif"), "by_one.gpkg"});
    run_well({"-q", "-ground", name + ".vrt", sample("town.tif"), "by_parts.gpkg"});
    EXPECT_EQ(layer("by_parts.gpkg", "buildings").records.size(),
              layer("by_one.gpkg", "buildings").records.size());
}

TEST_F(TilesTool, writesNoPartsOfOneFile) {
    well({"plan", "-q", sample("town.tif"), "a.gpkg", "work"});
    expect_refused(
        1,
        "'work' is the plan of one file, which merge writes; use -f FlatGeobuf and a folder to write parts.",
        {"write", "work", "0"});
}

TEST_F(TilesTool, isKilledAndRunAgain) {
    (void)whole({}, "one.gpkg");
    well({"plan", "-q", sample("town.tif"), "tiles.gpkg", "work"});
    for (const Arguments& step : {Arguments{"find", "work", "0"}, Arguments{"join", "work"},
                                  Arguments{"draw", "work", "0"}, Arguments{"merge", "-q", "work"}}) {
        for (const int after : {20, 60, 150})
            (void)tiles(step, Kill{SIGKILL, std::chrono::milliseconds(after)});
        // The last step may have been quicker than the signal.
        if (step[0] == "merge")
            std::filesystem::remove(path("tiles.gpkg"));
        well(step);
    }
    EXPECT_TRUE(read_bytes(path("tiles.gpkg")) == read_bytes(path("one.gpkg")));
}

TEST_F(TilesTool, worksFromAnyFolder) {
    std::filesystem::copy(sample("town.tif"), path("town.tif"));
    well({"plan", "-q", "-layers", "buildings", "town.tif", "tiles.gpkg", "work"});
    std::filesystem::create_directory(path("elsewhere"));
    ToolSetup setup;
    setup.working_directory = path("elsewhere");
    for (const Arguments& step :
         {Arguments{"find", "0"}, Arguments{"join"}, Arguments{"draw", "0"}, Arguments{"merge"}}) {
        Arguments command{D2B_TILES_TOOL, step[0], path("work")};
        command.insert(command.end(), step.begin() + 1, step.end());
        EXPECT_EQ(run_tool(command, setup).err, "");
    }
    EXPECT_TRUE(std::filesystem::exists(path("tiles.gpkg")));
}

TEST_F(TilesTool, refusesWhatItCannotDo) {
    expect_refused(2,
                   "-write_canopy in tiles is one file per tile and a VRT that joins them; give the name of "
                   "the VRT on a disk, such as a.vrt, not \"a.tif\".",
                   {"plan", "-write_canopy", "a.tif", sample("town.tif"), "a.gpkg", "work"});
    expect_refused(
        2, "-page does not work in tiles: a page needs the whole area; leave it out, or run dem2buildings.",
        {"plan", "-page", "a.html", sample("town.tif"), "a.gpkg", "work"});
    expect_refused(2,
                   "-footprints cannot be written in parts, because each footprint comes back once and in "
                   "order; write one file, such as a GeoPackage.",
                   {"plan", "-f", "FlatGeobuf", "-footprints", sample("town_truth.gpkg"), sample("town.tif"),
                    "parts", "work"});
    expect_refused(2, "There is no tile to find; usage: dem2buildings_tiles find <work> <tile>....",
                   {"find", "work"});
    expect_refused(2, "Tile 3 is named twice; name it once.", {"draw", "work", "3", "1", "3"});
    expect_refused(
        1,
        "'" + path("work") +
            "/plan.json' cannot be read: No such file or directory; run 'dem2buildings_tiles plan' first, "
            "or give the work folder that it was given.",
        {"join", "work"});
}

TEST_F(TilesTool, refusesPlansThatAreNone) {
    std::filesystem::create_directory(path("work"));
    const auto expect = [&](const std::string& plan, const std::string& why) {
        std::ofstream(path("work/plan.json"), std::ios::binary) << plan;
        expect_refused(1,
                       "'" + path("work") + "/plan.json' " + why +
                           "; run 'dem2buildings_tiles plan' with a new work folder.",
                       {"join", "work"});
    };
    expect("", "is not a complete plan");
    expect("[]", "is not a complete plan");
    expect(R"({"program": 1})", "is not a complete plan");
    expect(R"({"program": "dem2buildings_tiles", "version": "0.0.0"})",
           "was written by another version of dem2buildings");
    expect(R"({"program": "dem2buildings_tiles", "version": ")" D2B_VERSION R"("})",
           "is not a complete plan");
}

TEST_F(TilesTool, refusesAPlanThatWasChanged) {
    well({"plan", "-q", sample("town.tif"), "a.gpkg", "work"});
    const std::string made = read_bytes(path("work/plan.json"));
    const auto change = [&](const std::string& from, const std::string& to) {
        std::string bytes = made;
        bytes.replace(bytes.find(from), from.size(), to);
        std::ofstream(path("work/plan.json"), std::ios::binary) << bytes;
    };
    change("\"tiles\": 1", "\"tiles\": 7");
    for (const Arguments& step : {Arguments{"find", "work", "6"}, Arguments{"join", "work"}})
        expect_refused(1,
                       "'" + path("work") +
                           "/plan.json' has been changed: it has 7 tiles, and its options make 1; run "
                           "'dem2buildings_tiles plan' with a new work folder.",
                       step);
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"\"tile\": 1", "\"tile\": 1001"},
             {"\"tile\": 1", "\"tile\": 1e300"},
             {"\"tiles\": 1", "\"tiles\": 0"},
             {"\"tiles\": 1", "\"tiles\": 18446744073709551615"}}) {
        change(from, to);
        expect_refused(
            1,
            "'" + path("work") +
                "/plan.json' is not a complete plan; run 'dem2buildings_tiles plan' with a new work folder.",
            {"join", "work"});
    }
}

TEST_F(TilesTool, refusesTilesThatAreNotThere) {
    well({"plan", "-q", sample("town.tif"), "a.gpkg", "work"});
    expect_refused(1, "There is no tile 1; the plan has 1, numbered from 0.", {"find", "work", "0", "1"});
}

TEST_F(TilesTool, refusesASourceThatHasChanged) {
    std::filesystem::copy(sample("town.tif"), path("town.tif"));
    well({"plan", "-q", "town.tif", "a.gpkg", "work"});
    std::ofstream(path("town.tif"), std::ios::app | std::ios::binary) << "more";
    expect_refused(1, "'town.tif' has changed since the plan was made; plan again, with a new work folder.",
                   {"find", "work", "0"});
    expect_refused(2,
                   "'work' holds another plan, or the plan of a source that has changed; give another work "
                   "folder, or delete this one.",
                   {"plan", "town.tif", "a.gpkg", "work"});
}

TEST_F(TilesTool, refusesWhatLiesBesideASourceAndHasChanged) {
    std::filesystem::copy(sample("town.tif"), path("dtm.tif"));
    well({"plan", "-q", "-ground", "dtm.tif", sample("town.tif"), "a.gpkg", "work"});
    std::ofstream(path("dtm.tif"), std::ios::app | std::ios::binary) << "more";
    expect_refused(1, "'dtm.tif' has changed since the plan was made; plan again, with a new work folder.",
                   {"find", "work", "0"});
}

TEST_F(TilesTool, refusesFootprintsThatHaveChanged) {
    std::filesystem::copy(sample("town_parcels.gpkg"), path("mine.gpkg"));
    well({"plan", "-q", "-footprints", "mine.gpkg", sample("town.tif"), "a.gpkg", "work"});
    std::ofstream(path("mine.gpkg"), std::ios::app | std::ios::binary) << "more";
    expect_refused(1, "'mine.gpkg' has changed since the plan was made; plan again, with a new work folder.",
                   {"find", "work", "0"});
}

/// A plan that was killed before its footprints were written is made again.
TEST_F(TilesTool, namesThePlanWhereItsFootprintsAreMissing) {
    const Arguments plan{"plan",   "-q",  "-footprints", sample("town_parcels.gpkg"), sample("town.tif"),
                         "a.gpkg", "work"};
    well(plan);
    std::filesystem::remove(path("work/plan/0"));
    const ToolResult refused = tiles({"find", "work", "0"});
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("run 'plan'"), std::string::npos) << refused.err;
    well(plan);
    well({"find", "work", "0"});
}

TEST_F(TilesTool, losesNothingOnADiskThatIsFull) {
    well({"plan", "-q", sample("town.tif"), "a.gpkg", "work"});
    ToolSetup setup;
    setup.working_directory = folder_.string();
    const ToolResult full = run_tool(
        {"sh", "-c", "ulimit -f 1; exec \"$@\"", "sh", D2B_TILES_TOOL, "find", "-threads", "1", "work", "0"},
        setup);
    EXPECT_EQ(full.status, 1);
    EXPECT_EQ(full.err, "ERROR: '" + path("work/find/0") +
                            "' cannot be written: File too large; free some space in the work folder or "
                            "allow writing to it, and run the step again.\n");
    EXPECT_TRUE(std::filesystem::is_empty(path("work/find")));
    well({"find", "work", "0"});
}

TEST_F(TilesTool, refusesFilesThatAreNotItsOwn) {
    well({"plan", "-q", sample("town.tif"), "a.gpkg", "work"});
    std::filesystem::create_directory(path("work/find"));
    std::filesystem::copy(sample("town.tif"), path("work/find/0"));
    expect_refused(1,
                   "'" + path("work/find/0") +
                       "' is not the file that 'find' of tile 0 writes; delete it and run 'find' of tile 0 "
                       "again.",
                   {"join", "work"});
}

TEST_F(TilesTool, saysWhatATileTakes) {
    EXPECT_EQ(
        well({"plan", sample("town.tif"), "a.gpkg", "work"}),
        "1 tile in work. With one thread a tile takes 0.4 s to find and 0.3 s to draw, about, and 0.1 GB of "
        "memory; 0.1 GB of elevations are read.\n");
    const json plan = json::parse(read_bytes(path("work/plan.json")));
    EXPECT_EQ(plan["expected"]["memory_bytes_a_tile"], 30 * 1000 * 1000);
    EXPECT_EQ(plan["expected"]["bytes_read"], 8 * 1000 * 1000);
    EXPECT_DOUBLE_EQ(plan["expected"]["find_seconds_a_tile"], 0.36);
}

TEST_F(TilesTool, namesTheRunForThePresetThesis) {
    expect_refused(2,
                   "-preset thesis does not work in tiles, because a contour may fill the whole raster; run "
                   "dem2buildings -preset thesis.",
                   {"plan", "-preset", "thesis", sample("town.tif"), "a.gpkg", "work"});
}

TEST_F(TilesTool, refusesADestinationThatIsThere) {
    std::ofstream(path("a.gpkg")) << "not a database";
    const ToolResult result = tiles({"plan", sample("town.tif"), "a.gpkg", "work"});
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find("-overwrite"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(path("work")));
}

/// A GeoPackage may hold the parcels and the result, but not under one name.
TEST_F(TilesTool, keepsParcelsInTheDestination) {
    std::filesystem::copy(sample("town_parcels.gpkg"), path("city.gpkg"));
    const auto plan = [&](const std::string& name) {
        return Arguments{"plan", "-q", "-overwrite",       "-split_by", "city.gpkg",
                         "-nln", name, sample("town.tif"), "city.gpkg", "work"};
    };
    expect_refused(
        2,
        "The layer \"parcels\" of \"city.gpkg\" is that of -split_by, which -overwrite would replace; "
        "give another name with -nln.",
        plan("parcels"));
    well(plan("found"));
    for (const Arguments& step : {Arguments{"find", "-q", "work", "0"},
                                  {"join", "-q", "work"},
                                  {"draw", "-q", "work", "0"},
                                  {"merge", "-q", "work"}})
        well(step);
    EXPECT_EQ(layer_names(path("city.gpkg")),
              (std::vector<std::string>{"parcels", "found", "found_contours"}));
}

TEST_F(TilesTool, printsTextsAboutItself) {
    EXPECT_TRUE(well({"--help"}).starts_with("Usage:\n  dem2buildings_tiles plan [options] <src_raster>"));
    EXPECT_EQ(well({"--help-all"}), well({"-help"}));
    EXPECT_TRUE(well({"-version"}).starts_with("dem2buildings_tiles " D2B_VERSION ", GDAL "));
    EXPECT_TRUE(well({"-man"}).starts_with(".TH DEM2BUILDINGS_TILES 1"));
    EXPECT_TRUE(well({"-bash_completion"}).starts_with("# Completes command lines of dem2buildings_tiles"));
    const ToolResult nothing = tiles({});
    EXPECT_EQ(nothing.status, 2);
    EXPECT_TRUE(nothing.err.starts_with("Usage: dem2buildings_tiles "));
}

}  // namespace
}  // namespace d2b::test
