#include "dem2buildings/help.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "dem2buildings/json_report.hpp"
#include "dem2buildings/version.hpp"
#include "options/gdal_contour_options.hpp"
#include "support/run_tool.hpp"

namespace d2b::test {
namespace {

/// Text without the white space, so that line breaks do not matter.
std::string squeezed(std::string text) {
    std::erase_if(text, [](char letter) { return letter == ' ' || letter == '\n'; });
    return text;
}

bool holds(const std::string& text, const std::string& part) {
    return squeezed(text).find(squeezed(part)) != std::string::npos;
}

std::string without_backslashes(std::string text) {
    std::erase(text, '\\');
    return text;
}

TEST(Help, holdsEveryOptionThatIsNotHidden) {
    const std::string help = full_help();
    for (const OptionRow& row : option_table()) {
        EXPECT_EQ(holds(help, "  " + option_heading(row) + row.help), !row.hidden) << row.name;
        if (!row.standard.empty()) {
            EXPECT_TRUE(holds(help, "Default: " + row.standard + ".")) << row.name;
        }
    }
    for (const std::string_view group : option_group_names)
        EXPECT_NE(help.find("\n" + std::string(group) + ":\n"), std::string::npos) << group;
    for (const GdalSwitch& gdal : gdal_switches())
        EXPECT_TRUE(holds(help, std::string(gdal.synopsis))) << gdal.synopsis;
}

TEST(Help, holdsTheEverydayOptionsAlone) {
    const std::string help = everyday_help();
    std::ptrdiff_t everyday = 0;
    for (const OptionRow& row : option_table()) {
        EXPECT_EQ(holds(help, "  " + option_heading(row) + row.help), row.everyday) << row.name;
        everyday += row.everyday ? 1 : 0;
    }
    EXPECT_GE(everyday, 12);
    EXPECT_LE(everyday, 18);
    EXPECT_LE(std::ranges::count(help, '\n'), 60);  // about a screen
    EXPECT_TRUE(holds(help, "--help_all lists all options"));
}

TEST(Help, hasLinesOfAtMost80AsciiCharacters) {
    std::istringstream lines(everyday_help() + full_help() + short_usage());
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), 80U) << line;
        EXPECT_TRUE(std::ranges::all_of(line, [](char letter) { return letter >= ' ' && letter <= '~'; }))
            << line;
        EXPECT_FALSE(line.ends_with(' ')) << line;
    }
}

TEST(Help, ofOneOptionIsLaidOutInTwoColumns) {
    EXPECT_NE(
        full_help().find("  -b <band>               Band that holds the elevations. A whole number from 1\n"
                         "                          to 65536. Default: 1.\n"),
        std::string::npos);
    EXPECT_NE(full_help().find("  -q, -quiet              No progress and no summary.\n"), std::string::npos);
    EXPECT_NE(full_help().find("  -te <xmin> <ymin> <xmax> <ymax>\n                          Part"),
              std::string::npos);
}

TEST(Wrap, breaksAtBlanks) {
    EXPECT_EQ(wrap("aa bb cc", 0, 5), "aa bb\ncc\n");
    EXPECT_EQ(wrap("aa bb cc", 2, 5), "  aa\n  bb\n  cc\n");
    EXPECT_EQ(wrap("aaaaaaaa b", 1, 5), " aaaaaaaa\n b\n");
    EXPECT_EQ(wrap("  a   b ", 0, 5), "a b\n");
}

TEST(ManPage, holdsEveryOption) {
    const std::string page = without_backslashes(man_page());
    for (const OptionRow& row : option_table()) {
        EXPECT_EQ(holds(page, option_heading(row) + "fR" + row.help), !row.hidden) << row.name;
        if (!row.hidden) {
            EXPECT_TRUE(holds(page, row.help + row.details)) << row.name;
        }
    }
    for (const GdalContourOption& option : gdal_contour_options())
        EXPECT_TRUE(holds(page, std::string(option.synopsis) + "fR")) << option.name;
}

TEST(ManPage, isRoffWithoutWarnings) {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("d2b_man_page_" + std::to_string(getpid()) + ".1");
    std::ofstream(path) << man_page();
    ToolResult result;
    try {
        result = run_tool({"groff", "-man", "-ww", "-Tascii", "-P-cbou", path.string()});
    } catch (const std::runtime_error&) {
        std::filesystem::remove(path);
        GTEST_SKIP() << "groff is not installed";
    }
    std::filesystem::remove(path);
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    for (const char* part : {"DEM2BUILDINGS(1)", "-lod <n>", "EXIT STATUS", "--config <KEY>=<VALUE>"})
        EXPECT_NE(result.out.find(part), std::string::npos) << part;
}

TEST(OptionsMarkdown, holdsEveryOption) {
    const std::string text = options_markdown();
    for (const OptionRow& row : option_table()) {
        const std::string entry = "- `" + option_heading(row) + "`: " + row.help;
        EXPECT_EQ(holds(without_backslashes(text), entry + row.details + option_facts(row)), !row.hidden)
            << row.name;
    }
}

TEST(OptionsMarkdown, givesTheFateOfEveryOptionOfGdalContour) {
    const std::string text = options_markdown();
    for (const GdalContourOption& option : gdal_contour_options())
        EXPECT_TRUE(holds(without_backslashes(text), "`-" + std::string(option.name))) << option.name;
}

TEST(OptionFacts, giveRangeUnitAndDefault) {
    EXPECT_EQ(option_facts(*find_option("lod")), "A whole number from 1 to 10000. Default: 4.");
    EXPECT_EQ(option_facts(*find_option("min_area")), "At least 0.");
    EXPECT_EQ(option_facts(*find_option("oo")), "May be repeated.");
    EXPECT_EQ(option_facts(*find_option("min_height")), "At least 0. Default: 2. Not with -preset thesis.");
    EXPECT_EQ(option_facts(*find_option("ground")), "Not with -preset thesis, except none.");
    EXPECT_EQ(option_facts(*find_option("min_height"), true), "At least 0. Default: 2.");
    EXPECT_EQ(option_facts(*find_option("preset")), "Default: buildings.");
    EXPECT_EQ(option_facts(*find_option("trace")), "");
    EXPECT_EQ(option_facts(*find_option("q")), "");
}

using Json = nlohmann::ordered_json;

RunReport filled() {
    RunReport report;
    report.input = "in \"quoted\".tif";
    report.driver = "GTiff";
    report.output = "out.gpkg";
    report.crs = "ETRS89 / UTM zone 32N";
    report.output_crs = "WGS 84";
    report.units = {"metre", "CRS", 1, "US survey foot", "band", 1200.0 / 3937, "geodesic"};
    report.rows = 3;
    report.cols = 4;
    report.points = 12;
    report.valid_points = 11;
    report.minimum = -1.5;
    report.maximum = 20.1;
    report.mean = 1.0 / 3;
    report.standard_deviation = 0.1;
    report.levels = {{0, -1.5, 1, 11}, {1, 2.5, 3, 7}};
    report.doubtful = 1;
    report.stack_rmse_m = 0.75;
    report.contours = 4;
    report.buildings = 2;
    report.vertices = 99;
    report.building_outlines = {10, 0, 0.5};
    report.contour_outlines = {20, 5, 1.5};
    report.count(Reason::contour_short, 5);
    report.count(Reason::polygon_repaired, 6);
    report.seconds[0] = 0.25;
    report.surface = SurfaceReport{{391000, 5820000, -3}, 5, 4, 100, 184};
    report.roofs = RoofReport{5, 7, 2, 1000.5, 12.25};
    report.cuts = {{1, 2.5}, {2, 0.75}};
    report.sampling = SamplingReport{0.25, 1.5, {}, 0.25};
    report.peak_memory_bytes[static_cast<std::size_t>(Stage::write)] = 1LL << 40;
    report.warnings = {"first", "second"};
    return report;
}

TEST(JsonReport, readsBackAsItWas) {
    const Json json = Json::parse(json_report(filled()));
    EXPECT_EQ(json["version"], version);
    EXPECT_EQ(json["surface"], (Json{{"origin", {391000, 5820000, -3}},
                                     {"buildings", 5},
                                     {"blocks", 4},
                                     {"points", 100},
                                     {"triangles", 184}}));
    EXPECT_FALSE(Json::parse(json_report({})).contains("surface"));
    EXPECT_EQ(json["roofs"], (Json{{"faces", 14},
                                   {"flat", 5},
                                   {"pitched", 7},
                                   {"doubtful", 2},
                                   {"area_m2", 1000.5},
                                   {"doubtful_area_m2", 12.25}}));
    EXPECT_FALSE(Json::parse(json_report({})).contains("roofs"));
    EXPECT_EQ(json["truncated_stacks"],
              Json::parse(R"([{"level":1,"rmse_m":2.5},{"level":2,"rmse_m":0.75}])"));
    EXPECT_FALSE(Json::parse(json_report({})).contains("truncated_stacks"));
    EXPECT_EQ(
        json["sampling"],
        Json::parse(
            R"({"interpolated_fraction":0.25,"points_per_cell":1.5,"edge_width_cells":null,"value_step":0.25})"));
    EXPECT_FALSE(Json::parse(json_report({})).contains("sampling"));
    EXPECT_EQ(json["input"], (Json{{"name", "in \"quoted\".tif"},
                                   {"driver", "GTiff"},
                                   {"crs", "ETRS89 / UTM zone 32N"},
                                   {"rows", 3},
                                   {"cols", 4},
                                   {"points", 12},
                                   {"valid_points", 11},
                                   {"minimum", -1.5},
                                   {"maximum", 20.1},
                                   {"mean", 1.0 / 3},
                                   {"standard_deviation", 0.1}}));
    EXPECT_EQ(json["units"], (Json{{"horizontal", "metre"},
                                   {"horizontal_source", "CRS"},
                                   {"horizontal_metres", 1.0},
                                   {"vertical", "US survey foot"},
                                   {"vertical_source", "band"},
                                   {"vertical_metres", 1200.0 / 3937},
                                   {"areas", "geodesic"}}));
    EXPECT_EQ(json["levels"], Json::parse(R"([{"level":0,"threshold":-1.5,"contours":1,"points":11},
                                              {"level":1,"threshold":2.5,"contours":3,"points":7}])"));
    EXPECT_EQ(
        json["output"],
        Json::parse(
            R"({"name":"out.gpkg","crs":"WGS 84","buildings":2,"doubtful":1,"stack_rmse_m":0.75,"contours":4,"vertices":99,
                "outline_length_m":{"buildings":{"fitted":10.0,"simplified":0.0,"traced":0.5},
                                    "contours":{"fitted":20.0,"simplified":5.0,"traced":1.5}}})"));
    EXPECT_EQ(json["warnings"], Json::parse(R"(["first","second"])"));
}

TEST(JsonReport, namesEveryReasonAndEveryStage) {
    const Json json = Json::parse(json_report(filled()));
    ASSERT_EQ(json["dropped"].size(), reason_names.size());
    for (const std::string_view name : reason_names)
        EXPECT_EQ(json["dropped"][std::string(name)], name == "contour_short"      ? 5
                                                      : name == "polygon_repaired" ? 6
                                                                                   : 0)
            << name;
    ASSERT_EQ(json["stages"].size(), stage_names.size());
    for (const std::string_view name : stage_names) {
        const Json& stage = json["stages"][std::string(name)];
        EXPECT_EQ(stage["seconds"], name == "read" ? 0.25 : 0.0) << name;
        EXPECT_EQ(stage["peak_memory_bytes"], name == "write" ? 1LL << 40 : 0) << name;
    }
}

TEST(JsonReport, keepsTheOrderOfItsKeys) {
    const Json json = Json::parse(json_report({}));
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items())
        keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"version", "input", "units", "levels", "output", "dropped",
                                              "threads", "stages", "warnings"}));
    EXPECT_EQ(json["levels"], Json::array());
    EXPECT_EQ(json["warnings"], Json::array());
}

TEST(JsonReport, survivesWhatJsonCannotHold) {
    RunReport report;
    report.mean = std::numeric_limits<double>::quiet_NaN();
    report.levels = {{1, report.mean, 2, 3}};
    report.input = "bad\xff";
    report.warnings = {"line\nbreak"};
    const Json json = Json::parse(json_report(report));
    EXPECT_TRUE(json["input"]["mean"].is_null());
    EXPECT_EQ(json["levels"], Json::parse(R"([{"level":1,"threshold":null,"contours":2,"points":3}])"));
    EXPECT_EQ(json["input"]["name"], "bad\xef\xbf\xbd");
    EXPECT_EQ(json["warnings"][0], "line\nbreak");
}

}  // namespace
}  // namespace d2b::test
