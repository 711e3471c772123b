#include "dem2buildings/help.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "options/gdal_contour_options.hpp"
#include "support/run_tool.hpp"

namespace d2b::test {
namespace {

/// Without the white space, so that line breaks do not matter.
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

TEST(Help, endsWithTwoExamples) {
    EXPECT_TRUE(full_help().ends_with(
        "\nExamples:\n"
        "  dem2buildings city.tif buildings.gpkg\n"
        "  dem2buildings -ground terrain.tif -preview map.png city.tif buildings.gpkg\n"));
}

TEST(Help, hasLinesOfAtMost80AsciiCharacters) {
    std::istringstream lines(full_help() + short_usage());
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

TEST(Help, shortUsageIsTwoLines) {
    EXPECT_EQ(short_usage(),
              "Usage: dem2buildings [options] <src_raster> <dst_vector>\nTry dem2buildings --help for the "
              "options.\n");
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
        EXPECT_EQ(text.find("- `" + option_heading(row) + "`: ") != std::string::npos, !row.hidden)
            << row.name;
        if (!row.hidden) {
            EXPECT_TRUE(holds(without_backslashes(text), row.help + row.details + option_facts(row)))
                << row.name;
        }
    }
}

TEST(OptionsMarkdown, givesTheFateOfEveryOptionOfGdalContour) {
    const std::string text = options_markdown();
    EXPECT_NE(text.find("\n- `-a <field>`: refused, because elevations are always in the fields threshold"),
              std::string::npos);
    EXPECT_NE(text.find("\n- `-p`: accepted, because polygons are always written.\n"), std::string::npos);
    EXPECT_NE(text.find("\n- `-gt <n>|unlimited`: refused, because "), std::string::npos);
    for (const GdalContourOption& option : gdal_contour_options())
        EXPECT_TRUE(holds(without_backslashes(text), std::string(option.synopsis))) << option.name;
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

}  // namespace
}  // namespace d2b::test
