#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/score_case.hpp"
#include "read/rasters.hpp"

namespace d2b::test {
namespace {

using nlohmann::json;

/// A building of a result: its number, outline and values.
struct ResultRow {
    int id = 1;
    std::string wkt;
    std::string p90 = "6";
    std::string confidence = "0.9";
};

/// Runs dem2buildings_compare in an empty folder of its own.
class CompareTool : public ScoreCase {
  protected:
    /// Places in UTM zone 32.
    static std::string house(double x, double y, double width = 10, double height = 10) {
        return box(500000 + x, 5800000 + y, 500000 + x + width, 5800000 + y + height);
    }
    void result(const std::string& file, const std::vector<ResultRow>& rows, int epsg = 25832) const {
        RowLayer layer{.name = "buildings",
                       .fields = {{"id", OFTInteger64}, {"p90", OFTReal}, {"confidence", OFTReal}},
                       .epsg = epsg};
        for (const ResultRow& row : rows)
            layer.rows.push_back({row.wkt, {std::to_string(row.id), row.p90, row.confidence}});
        write_rows(path(file), layer);
    }
    [[nodiscard]] ToolResult compare(const Arguments& arguments, ToolSetup setup = {}) const {
        Arguments command{D2B_COMPARE_TOOL};
        command.insert(command.end(), arguments.begin(), arguments.end());
        setup.working_directory = folder_.string();
        return run_tool(command, setup);
    }
    json compare_json(Arguments arguments, const std::string& warnings = "") const {
        arguments.emplace_back("-json");
        const ToolResult done = compare(arguments);
        EXPECT_EQ(done.status, 0);
        EXPECT_EQ(done.err, warnings);
        return json::parse(done.out);
    }
    void expect_refusal(int status, const std::string& message, const Arguments& arguments) const {
        const auto before = entries();
        const ToolResult done = compare(arguments);
        EXPECT_EQ(done.status, status);
        EXPECT_EQ(done.err, "ERROR: " + message + "\n");
        EXPECT_EQ(done.out, "");
        EXPECT_EQ(entries(), before);
    }
    /// Two surveys with one change of each kind, and four houses that stay.
    void write_changes() const {
        std::vector<ResultRow> before{{1, house(0, 0)},        {2, house(50, 0)},  {3, house(100, 0)},
                                      {4, house(150, 0), "9"}, {5, house(200, 0)}, {6, house(250, 0, 20)}};
        std::vector<ResultRow> after{{11, house(300, 0), "4", "0.8"}, {12, house(0, 0)},
                                     {13, house(50, 0), "8.5"},       {14, house(150, 0), "6"},
                                     {15, house(200, 0, 13)},         {16, house(250, 0, 15)}};
        for (int i = 0; i < 4; ++i) {
            before.push_back({20 + i, house(50 * i, 100)});
            after.push_back({30 + i, house(50 * i, 100)});
        }
        result("old.gpkg", before);
        result("new.gpkg", after);
    }
    const Arguments both_{"old.gpkg", "new.gpkg"};
};

TEST_F(CompareTool, countsChanges) {
    write_changes();
    const json result = compare_json(both_);
    EXPECT_EQ(result["changes"].dump(),
              R"({"gone":1,"grown":1,"lowered":1,"new":1,"raised":1,"same":5,"shrunk":1})");
    EXPECT_EQ(result["old"]["buildings"], 10);
    EXPECT_EQ(result["new"]["layer"], "buildings");
    EXPECT_EQ(result["shift"]["east_m"], 0);
    EXPECT_EQ(result["crs"], "ETRS89 / UTM zone 32N");
    EXPECT_EQ(compare({"-q", "old.gpkg", "new.gpkg"}).out,
              "new       1\ngone      1\nraised    1\nlowered   1\ngrown     1\nshrunk    1\nsame      5\n");
    EXPECT_EQ(entries(), (std::vector<std::string>{"new.gpkg", "old.gpkg"}));
}

TEST_F(CompareTool, writesALayer) {
    write_changes();
    const ToolResult done = compare({"old.gpkg", "new.gpkg", "out.gpkg"});
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_NE(done.out.find("\nchanges   out.gpkg\n"), std::string::npos) << done.out;
    const Layer changes = layer("out.gpkg", "changes");
    EXPECT_EQ(changes.fields,
              (std::vector<std::string>{"id", "change", "old_id", "new_id", "n_old", "n_new", "p90_old",
                                        "p90_new", "rise", "area_old", "area_new", "confidence"}));
    EXPECT_EQ(changes.crs, "ETRS89 / UTM zone 32N");
    EXPECT_EQ(changes.metadata.at("D2B_OLD"), "old.gpkg");
    EXPECT_EQ(changes.metadata.at("D2B_NEW"), "new.gpkg");
    ASSERT_EQ(changes.records.size(), 11U);
    const Record& built = changes.where("id", 1);
    EXPECT_EQ(built.text("change"), "new");
    EXPECT_EQ(built.number("new_id"), 11);
    EXPECT_TRUE(built.is_null("old_id") && built.is_null("p90_old") && built.is_null("area_old") &&
                built.is_null("rise"));
    EXPECT_EQ(built.number("confidence"), 0.8);
    EXPECT_EQ(built.box().MinX, 500300);
    const Record& gone = changes.where("id", 11);
    EXPECT_EQ(gone.text("change"), "gone");
    EXPECT_EQ(gone.number("old_id"), 3);
    EXPECT_TRUE(gone.is_null("new_id"));
    EXPECT_EQ(gone.box().MinX, 500100);
    const Record& raised = changes.where("id", 3);
    EXPECT_EQ(raised.text("change"), "raised");
    EXPECT_EQ(raised.number("new_id"), 13);
    EXPECT_EQ(raised.number("p90_old"), 6);
    EXPECT_EQ(raised.number("p90_new"), 8.5);
    EXPECT_EQ(raised.number("rise"), 2.5);
    const Record& grown = changes.where("id", 5);
    EXPECT_EQ(grown.text("change"), "grown");
    // Area on the ellipsoid, at a scale of 0.9996.
    EXPECT_NEAR(grown.number("area_old"), 100 / (0.9996 * 0.9996), 0.02);
    EXPECT_EQ(grown.area(), 130);
    EXPECT_NE(sql_value(path("out.gpkg"), "SELECT styleQML FROM layer_styles WHERE f_table_name = 'changes'")
                  .find("&quot;change&quot; = 'lowered'"),
              std::string::npos);
}

TEST_F(CompareTool, replacesItsLayerAlone) {
    write_changes();
    layer_of("out.gpkg", {"plots", {{house(0, 0)}}});
    expect_refusal(2, "\"out.gpkg\" exists; give -overwrite to replace the changes in it, or another name.",
                   {"old.gpkg", "new.gpkg", "out.gpkg"});
    for (int i = 0; i < 2; ++i)
        EXPECT_EQ(compare({"-q", "-overwrite", "old.gpkg", "new.gpkg", "out.gpkg"}).status, 0);
    EXPECT_EQ(layer("out.gpkg", "plots").records.size(), 1U);
    EXPECT_EQ(layer("out.gpkg", "changes").records.size(), 11U);
}

TEST_F(CompareTool, leavesTheSurveysAlone) {
    write_changes();
    for (const std::string& survey : both_)
        expect_refusal(2, "The destination '" + survey + "' is a survey; give another name.",
                       {"-overwrite", "old.gpkg", "new.gpkg", survey});
}

TEST_F(CompareTool, writesOtherFormats) {
    write_changes();
    EXPECT_EQ(compare({"-q", "old.gpkg", "new.gpkg", "out.shp"}).status, 0);
    EXPECT_EQ(layer("out.shp", "out").records.size(), 11U);
}

#ifdef D2B_PAGE

TEST_F(CompareTool, writesAPage) {
    write_changes();
    EXPECT_EQ(compare_json({"-page", "out.html", "old.gpkg", "new.gpkg"})["page"], "out.html");
    const std::string page = read_bytes(path("out.html"));
    EXPECT_NE(page.find("<title>out</title>"), std::string::npos);
    EXPECT_EQ(page.find(folder_.string()), std::string::npos);
    expect_refusal(2, "\"out.html\" exists; give another name, or -overwrite to replace it.",
                   {"-page", "out.html", "old.gpkg", "new.gpkg", "out.gpkg"});
    EXPECT_EQ(compare({"-q", "-overwrite", "-page", "out.html", "old.gpkg", "new.gpkg", "out.gpkg"}).status,
              0);
    EXPECT_EQ(read_bytes(path("out.html")), page);
    EXPECT_EQ(layer("out.gpkg", "changes").records.size(), 11U);
    const auto titled = [this](const std::string& credit) {
        EXPECT_EQ(compare({"-q", "-overwrite", "-page", "titled.html", "-title", "Town since 2020", "-credit",
                           credit, "old.gpkg", "new.gpkg"})
                      .status,
                  0);
        return read_bytes(path("titled.html"));
    };
    EXPECT_NE(titled("City").find("<title>Town since 2020</title>"), std::string::npos);
    EXPECT_TRUE(titled("City") == titled("City") && titled("City") != titled("State"));
    expect_refusal(2, "Pages are written as HTML; give \"a.htm\" a name that ends in .html.",
                   {"-page", "a.htm", "old.gpkg", "new.gpkg"});
    // A run that fails leaves the page as it was.
    expect_refusal(1, "'none.gpkg' cannot be opened as a raster: No such file or directory.",
                   {"-overwrite", "-page", "out.html", "old.gpkg", "none.gpkg"});
    EXPECT_EQ(read_bytes(path("out.html")), page);
}

#endif

TEST_F(CompareTool, writesAStream) {
    write_changes();
    const ToolResult done = compare({"-f", "GeoJSON", "old.gpkg", "new.gpkg", "/vsistdout/"});
    EXPECT_EQ(done.status, 0) << done.err;
    const json streamed = json::parse(done.out);
    EXPECT_EQ(streamed["name"], "changes");
    EXPECT_EQ(streamed["features"].size(), 11U);
}

TEST_F(CompareTool, losesItsText) {
    write_changes();
    const ToolSetup full{.stdout_file = "/dev/full"};
    const std::string lost =
        "ERROR: Cannot write to stdout; check whether the disk is full or the reader has gone.\n";
    for (const Arguments& arguments : {both_, Arguments{"-json", "old.gpkg", "new.gpkg", "out.gpkg"},
                                       Arguments{"-f", "GeoJSON", "old.gpkg", "new.gpkg", "/vsistdout/"}}) {
        const ToolResult failed = compare(arguments, full);
        EXPECT_EQ(failed.status, 1);
        EXPECT_EQ(failed.err, lost);
    }
    EXPECT_EQ(entries(), (std::vector<std::string>{"new.gpkg", "old.gpkg"}));
    const ToolResult whole = compare({"old.gpkg", "new.gpkg", "out.gpkg"}, full);
    EXPECT_EQ(whole.status, 0);
    EXPECT_EQ(whole.err, "Warning: The summary could not be written to stdout; the result is whole.\n");
    EXPECT_EQ(layer("out.gpkg", "changes").records.size(), 11U);
}

TEST_F(CompareTool, findsAShift) {
    std::vector<ResultRow> before;
    std::vector<ResultRow> after;
    for (int i = 0; i < 5; ++i) {
        before.push_back({i + 1, house(40 * i, 0, 8 + i)});
        after.push_back({i + 1, house(40 * i + 1.25, -0.75, 8 + i)});
    }
    result("old.gpkg", before);
    result("new.gpkg", after);
    const json shift = compare_json(both_)["shift"];
    EXPECT_NEAR(shift["east_m"], 1.25, 1e-6);
    EXPECT_NEAR(shift["north_m"], -0.75, 1e-6);
    EXPECT_EQ(shift["pairs"], 5);
    EXPECT_NE(compare(both_).out.find("shift     1.25 m east, 0.75 m south, from 5 buildings\n"),
              std::string::npos);
}

TEST_F(CompareTool, comparesOtherReferenceSystems) {
    // A hundred-thousandth of a degree is 1.11 m northwards and 0.68 m eastwards at 52.3 degrees.
    const auto lot = [](double lon, double lat) { return box(lon, lat, lon + 0.0002, lat + 0.0001); };
    result("old.gpkg", {{1, lot(9, 52.3)}, {2, lot(9.001, 52.3)}}, 4326);
    result("new.gpkg", {{1, lot(9, 52.3)}}, 4326);
    const json degrees = compare_json(both_);
    EXPECT_EQ(degrees["changes"]["same"], 1);
    EXPECT_EQ(degrees["changes"]["gone"], 1);
    // The first is at 500000, 5794406 in zone 32.
    result("plane.gpkg", {{1, box(500000, 5794406, 500013.6, 5794417)}});
    EXPECT_EQ(compare({"-q", "old.gpkg", "plane.gpkg", "out.gpkg"}).status, 0);
    const Layer changes = layer("out.gpkg", "changes");
    EXPECT_EQ(changes.crs, "ETRS89 / UTM zone 32N");
    EXPECT_NEAR(changes.where("id", 2).box().MinX, 500068, 1);  // 0.001 degrees
}

TEST_F(CompareTool, knowsTheFieldsOfOtherPrograms) {
    write_rows(path("old.gpkg"), {.name = "buildings",
                                  .fields = {{"ID_BUILD", OFTInteger64}, {"ROOF_HEIGHT", OFTReal}},
                                  .rows = {{house(0, 0), {"7", "6"}}}});
    result("new.gpkg", {{1, house(0, 0), "9"}});
    EXPECT_EQ(compare_json(both_)["changes"]["raised"], 1);
}

TEST_F(CompareTool, comparesNothing) {
    result("old.gpkg", {});
    result("new.gpkg", {{1, house(0, 0)}});
    EXPECT_EQ(compare_json(both_)["changes"]["new"], 1);
    EXPECT_EQ(compare_json({"old.gpkg", "old.gpkg"})["changes"]["same"], 0);
}

TEST_F(CompareTool, refusesAResultAndARaster) {
    result("old.gpkg", {{1, house(0, 0)}});
    write(path("new.tif"), {.cols = 2, .rows = 2, .values = {1, 2, 3, 4}});
    expect_refusal(2, "'old.gpkg' has buildings and 'new.tif' is a raster; give two results or two DSMs.",
                   {"old.gpkg", "new.tif"});
    expect_refusal(2, "'old.gpkg' has buildings and 'new.tif' is a raster; give two results or two DSMs.",
                   {"new.tif", "old.gpkg"});
}

TEST_F(CompareTool, refusesWhatItCannotRead) {
    result("old.gpkg", {{1, house(0, 0)}});
    const ToolResult missing = compare({"old.gpkg", "none.gpkg"});
    EXPECT_EQ(missing.status, 1);
    EXPECT_EQ(missing.err.rfind("ERROR: 'none.gpkg'", 0), 0U) << missing.err;
    layer_of("plain.gpkg", {"houses", {{house(0, 0), 6}}});
    expect_refusal(2, "The layer 'houses' of 'plain.gpkg' has no field 'id'; its fields are 'height'.",
                   {"old.gpkg", "plain.gpkg"});
    write_rows(path("no_heights.gpkg"),
               {.name = "buildings", .fields = {{"id", OFTInteger64}}, .rows = {{house(0, 0), {"1"}}}});
    expect_refusal(2, "The layer 'buildings' of 'no_heights.gpkg' has no field 'p90'; its fields are 'id'.",
                   {"old.gpkg", "no_heights.gpkg"});
}

TEST_F(CompareTool, warnsOfSurveysThatDoNotMeet) {
    result("old.gpkg", {{1, house(0, 0)}});
    result("new.gpkg", {{1, house(5000, 0)}});
    const json result = compare_json(
        both_,
        "Warning: 'old.gpkg' and 'new.gpkg' have no building in common; check the files and their coordinate "
        "reference systems.\n");
    EXPECT_EQ(result["changes"]["new"], 1);
    EXPECT_EQ(result["changes"]["gone"], 1);
}

TEST_F(CompareTool, findsTheTownTheSame) {
    const json same = compare_json({sample("town.tif"), sample("town.tif")});
    EXPECT_EQ(same["changes"]["same"], same["new"]["buildings"]);
    EXPECT_GT(same["new"]["buildings"], 300);
    EXPECT_EQ(same["new"]["layer"], nullptr);
    EXPECT_NEAR(same["new"]["cell_m"], 1, 0.05);
    EXPECT_EQ(same["shift"]["east_m"], 0);
}

/// A comparison has no -snodata.
TEST_F(CompareTool, tellsWhereOptionsBelong) {
    RasterSpec spec = blocks();
    fill(spec, 15, 15, 5, 5, 5000);
    write(path("old.tif"), spec);
    write(path("new.tif"), spec);
    const auto spike = [](const std::string& file) {
        return "Warning: 1 cell of '" + file +
               "' has the elevation 5000, more than 100 m above all cells around, and is treated as no data; "
               "if 5000 stands for no data, give -snodata 5000.\n";
    };
    EXPECT_EQ(
        compare({"-q", "old.tif", "new.tif"}).err,
        spike("old.tif") +
            "Warning: These options are those of dem2buildings; to use them, run it on each DSM and compare "
            "the two results.\n" +
            spike("new.tif"));
}

TEST_F(CompareTool, numbersBuildingsOfRastersAsAResultDoes) {
    preset_.clear();
    run_well({"-q", sample("town.tif"), "town.gpkg"});
    EXPECT_EQ(compare({"-q", sample("town.tif"), sample("town.tif"), "out.gpkg"}).status, 0);
    const Layer town = layer("town.gpkg", "buildings");
    const Layer changes = layer("out.gpkg", "changes");
    ASSERT_EQ(changes.records.size(), town.records.size());
    for (const Record& building : town.records) {
        const Record& change = changes.where("new_id", building.number("id"));
        EXPECT_EQ(change.number("old_id"), building.number("id"));
        EXPECT_EQ(change.number("p90_new"), building.number("p90"));
        EXPECT_EQ(change.number("confidence"), building.number("confidence"));
        EXPECT_NEAR(change.number("area_new"), building.number("area_m2"), 0.011);
    }
}

TEST_F(CompareTool, printsItsTexts) {
    EXPECT_EQ(compare({"--help"}).out.rfind("Usage: dem2buildings_compare [options] <old> <new>", 0), 0U);
    EXPECT_EQ(compare({"-version"}).out.rfind(std::string("dem2buildings_compare ") + D2B_VERSION, 0), 0U);
    EXPECT_EQ(compare({"-man"}).out.rfind(".TH DEM2BUILDINGS_COMPARE 1", 0), 0U);
    EXPECT_EQ(compare({}).status, 2);
}

}  // namespace
}  // namespace d2b::test
