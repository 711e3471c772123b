#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "cli/cli_test_case.hpp"
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

/// What is the same as in gdal_contour is in the table, where every option has a test; the rest is refused.
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
}  // namespace d2b::test
