#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "cli/cli_test_case.hpp"
#include "cli/option_effect.hpp"
#include "dem2buildings/help.hpp"
#include "options/gdal_contour_options.hpp"
#include "options/option_table.hpp"

namespace d2b::test {
namespace {

/// The tests of a suite in this program, each up to "__".
std::set<std::string> tests_of(const std::string& suite_name) {
    std::set<std::string> names;
    const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
    for (int i = 0; i < all.total_test_suite_count(); ++i) {
        const ::testing::TestSuite& suite = *all.GetTestSuite(i);
        for (int j = 0; suite.name() == suite_name && j < suite.total_test_count(); ++j) {
            const std::string name = suite.GetTestInfo(j)->name();
            names.insert(name.substr(0, name.find("__")));
        }
    }
    return names;
}

TEST(Coverage, everyOptionHasATestOfItsEffect) {
    std::set<std::string> options;
    for (const OptionRow& row : option_table())
        options.insert(row.name);
    EXPECT_EQ(tests_of("OptionEffect"), options);
}

TEST(Coverage, everySwitchOfGdalHasATestOfItsEffect) {
    std::set<std::string> switches;
    for (const GdalSwitch& one : gdal_switches()) {
        std::string name(one.synopsis.substr(2, one.synopsis.find(' ') - 2));
        std::ranges::replace(name, '-', '_');
        switches.insert(name);
    }
    EXPECT_EQ(tests_of("GdalSwitchEffect"), switches);
}

class ContourOptions : public CliTest {};

/// Options that are the same as in gdal_contour are in the table, where each has a test; the rest is refused.
TEST_F(ContourOptions, areTakenOrRefusedAsTheTableSays) {
    write(path("dem.tif"), blocks());
    for (const GdalContourOption& option : gdal_contour_options()) {
        const std::string name(option.name);
        if (option.fate == OptionSupport::refused)
            expect_error(2,
                         "-" + name + " of gdal_contour has no use here: " + std::string(option.note) + ".",
                         {"-" + name, "1", "dem.tif", "out.gpkg"});
        else
            EXPECT_NE(find_option(name), nullptr) << name;
    }
}

TEST_F(ContourOptions, workInACommandLineOfGdalContour) {
    write(path("dem.tif"), blocks());
    run_well({"-b", "1", "-p", "-3d", "-snodata", "-1", "-i", "10", "-off", "5", "-f", "GPKG", "-nln", "iso",
              "-lco", "FID=nr", "-q", "dem.tif", "out.gpkg"});
    EXPECT_EQ(layer("out.gpkg", "iso").records.size(), 2U);
    EXPECT_EQ(layer("out.gpkg", "iso_contours").count(2), 1);
}

}  // namespace

TEST_F(GdalSwitchEffect, config) {
    const std::string last_change = "SELECT last_change FROM gpkg_contents WHERE table_name = 'buildings'";
    trace({"--config", "OGR_CURRENT_DATE", "2001-02-03T04:05:06.000Z"});
    EXPECT_EQ(sql_value(path("out.gpkg"), last_change), "2001/02/03 04:05:06+00");
    trace({"--config", "OGR_CURRENT_DATE=2011-02-03T04:05:06.000Z", "-overwrite"});
    EXPECT_EQ(sql_value(path("out.gpkg"), last_change), "2011/02/03 04:05:06+00");
}

TEST_F(GdalSwitchEffect, debug) {
    const ToolResult result = run({"--debug", "on", "-q", "blocks.tif", "out.gpkg"});
    EXPECT_EQ(result.status, 0);
    expect_has(result.err, "blocks.tif");
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(run({"--debug", "off", "-q", "-overwrite", "blocks.tif", "out.gpkg"}).err, "");
}

TEST_F(GdalSwitchEffect, formats) {
    const std::string text = run_well({"--formats"});
    expect_has(text, "GTiff -raster");
    expect_has(text, "GPKG -raster,vector");
}

TEST_F(GdalSwitchEffect, format) {
    const std::string text = run_well({"--format", "GPKG"});
    expect_has(text, "Short Name: GPKG");
    expect_error(2, "NoSuch", {"--format", "NoSuch"});
}

TEST_F(GdalSwitchEffect, optfile) {
    write_text(path("my.opt"), "# every point counts\n-nf 0\n-layers buildings\n");
    trace({"--optfile", "my.opt"});
    EXPECT_EQ(layer_names(path("out.gpkg")), std::vector<std::string>{"buildings"});
    EXPECT_EQ(buildings().records.size(), 3U);
    expect_error(2, "none.opt", {"--optfile", "none.opt", "blocks.tif", "other.gpkg"});
}

TEST_F(GdalSwitchEffect, help_general) {
    expect_has(run_well({"--help-general"}), "--optfile");
}

}  // namespace d2b::test
