#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "dem2buildings_compare/command_line.hpp"
#include "dem2buildings_compare/help.hpp"
#include "dem2buildings_compare/report.hpp"
#include "support/error_of.hpp"

namespace d2b::test {
namespace {

std::string refusal_of_compare(const std::vector<std::string>& arguments) {
    return error_of<OptionError>([&] { static_cast<void>(parse_compare_command_line(arguments)); });
}

TEST(CompareCommandLine, readsOptionsAnywhere) {
    const CompareCommand request =
        parse_compare_command_line({"-q", "old.gpkg", "--json", "new.gpkg", "-overwrite", "out", "-f=GPKG"});
    EXPECT_EQ(request.old_survey, "old.gpkg");
    EXPECT_EQ(request.new_survey, "new.gpkg");
    EXPECT_EQ(request.destination, "out");
    EXPECT_EQ(request.format, "GPKG");
    EXPECT_TRUE(request.json && request.quiet && request.overwrite);
}

TEST(CompareCommandLine, hasDefaults) {
    const CompareCommand request = parse_compare_command_line({"a", "--", "-help_all"});
    EXPECT_EQ(request.new_survey, "-help_all");
    EXPECT_EQ(request.destination + request.page + request.title + request.credit, "");
    EXPECT_FALSE(request.json || request.quiet || request.overwrite || request.asks_for_text());
}

TEST(CompareCommandLine, asksForNoFileNamesWithHelp) {
    for (const char* word : {"--help", "-help", "-h", "--help_all", "-help-all", "--help-all"})
        EXPECT_TRUE(parse_compare_command_line({word}).help) << word;
    EXPECT_TRUE(parse_compare_command_line({"-version"}).version);
    EXPECT_TRUE(parse_compare_command_line({"-man"}).man_page);
}

TEST(CompareCommandLine, refusesWrongFileNames) {
    const std::string usage = "; usage: dem2buildings_compare [options] <old> <new> [<changes>].";
    EXPECT_EQ(refusal_of_compare({"-q"}), "The old and the new survey are missing" + usage);
    EXPECT_EQ(refusal_of_compare({"a"}), "The new survey is missing, there is only 'a'" + usage);
    EXPECT_EQ(refusal_of_compare({"a", "b", "c", "d"}),
              "There are too many file names, from 'd' on; give two surveys and one destination.");
    EXPECT_EQ(refusal_of_compare({"a", ""}), "A file name is empty" + usage);
    EXPECT_EQ(refusal_of_compare({"a", "b", "/vsimem/c.gpkg"}),
              "The destination '/vsimem/c.gpkg' is in memory and lost when the program ends; give a file.");
}

TEST(CompareCommandLine, readsTheWordsOfAPage) {
    const CompareCommand request = parse_compare_command_line(
        {"-page", "p.html", "-title", "Town since 2020", "-credit=Survey, CC BY", "a", "b"});
    EXPECT_EQ(request.title, "Town since 2020");
    EXPECT_EQ(request.credit, "Survey, CC BY");
    EXPECT_EQ(refusal_of_compare({"-title", "Town", "-credit", "Survey", "a", "b", "c"}),
              "-title needs -page <file.html>; it is the title of the page.");
    EXPECT_EQ(refusal_of_compare({"-credit", "Survey", "a", "b", "c"}),
              "-credit needs -page <file.html>; it is written on the page.");
}

TEST(CompareCommandLine, refusesOptionsWithoutEffect) {
    EXPECT_EQ(refusal_of_compare({"-overwrite", "a", "b"}),
              "-overwrite has no effect without a destination; give one, or leave it out.");
    EXPECT_EQ(refusal_of_compare({"-f", "GPKG", "a", "b"}),
              "-f has no effect without a destination; give one, or leave it out.");
    EXPECT_EQ(refusal_of_compare({"a", "b", "c", "-f"}), "-f needs a value: -f <format>.");
    EXPECT_EQ(refusal_of_compare({"-json", "a", "b", "/vsistdout/"}),
              "-json cannot be used with a destination in /vsistdout/; both would write to stdout.");
    EXPECT_EQ(refusal_of_compare({"-jsn", "a", "b"}), "There is no option -jsn; did you mean -json?");
    EXPECT_EQ(refusal_of_compare({"-json=1", "a", "b"}), "-json is a switch and takes no value.");
}

TEST(CompareHelp, namesEveryOptionAndFitsALine) {
    const std::string help = tool_help(compare_texts());
    const std::string man = tool_man_page(compare_texts());
    for (const CompareOption& option : compare_options()) {
        EXPECT_NE(help.find("  -" + option.name), std::string::npos) << option.name;
        EXPECT_NE(man.find("\\-" + option.name), std::string::npos) << option.name;
        EXPECT_FALSE(option.help.empty());
    }
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);)
        EXPECT_LE(line.size(), 80U) << line;
}

SurveyComparison comparison() {
    SurveyComparison result;
    result.old_survey = {"old.gpkg", "buildings", 12, 1, 1.04};
    result.new_survey = {"new.tif", "", 1, 0, {}};
    result.crs = "ETRS89 / UTM zone 32N";
    result.shift = {-1.234, 0.5, 9};
    result.counts = {1, 2, 3, 4, 5, 6, 7};
    return result;
}

TEST(CompareText, writesFigures) {
    EXPECT_EQ(comparison_text(comparison(), false),
              "old       old.gpkg, layer buildings: 12 buildings, cells of 1.0 m, 1 of them outside the "
              "other survey\n"
              "new       new.tif: 1 building\n"
              "shift     1.23 m west, 0.50 m north, from 9 buildings\n"
              "\n"
              "new       1\ngone      2\nraised    3\nlowered   4\ngrown     5\nshrunk    6\nsame      7\n");
    EXPECT_EQ(comparison_text(comparison(), true),
              "new       1\ngone      2\nraised    3\nlowered   4\ngrown     5\nshrunk    6\nsame      7\n");
    SurveyComparison without = comparison();
    without.shift = {};
    without.output = "out.gpkg";
    without.page = "out.html";
    const std::string text = comparison_text(without, false);
    EXPECT_NE(text.find("shift     not estimated, because fewer than 3 buildings agree on one\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("changes   out.gpkg\npage      out.html\n"), std::string::npos) << text;
}

TEST(CompareJson, hasAllFigures) {
    const auto json = nlohmann::ordered_json::parse(comparison_json(comparison()));
    std::string keys;
    for (const auto& [key, value] : json.items())
        keys += key + " ";
    EXPECT_EQ(keys, "version old new crs shift changes output page warnings ");
    EXPECT_EQ(json["old"]["layer"], "buildings");
    EXPECT_EQ(json["old"]["outside"], 1);
    EXPECT_EQ(json["old"]["cell_m"], 1.04);
    EXPECT_EQ(json["new"]["layer"], nullptr);
    EXPECT_EQ(json["new"]["cell_m"], nullptr);
    EXPECT_EQ(json["shift"]["east_m"], -1.234);
    EXPECT_EQ(json["shift"]["pairs"], 9);
    EXPECT_EQ(json["changes"].dump(),
              R"({"new":1,"gone":2,"raised":3,"lowered":4,"grown":5,"shrunk":6,"same":7})");
    EXPECT_EQ(json["output"], nullptr);
    EXPECT_EQ(json["page"], nullptr);
    SurveyComparison with_page = comparison();
    with_page.page = "changes.html";
    EXPECT_EQ(nlohmann::json::parse(comparison_json(with_page))["page"], "changes.html");
}

}  // namespace
}  // namespace d2b::test
