#include <cstdio>
#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <cpl_conv.h>
#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "read/gdal_setup.hpp"

namespace d2b::test {
namespace {

using Texts = std::vector<std::string>;

std::string gdal_config(const char* key) {
    return CPLGetConfigOption(key, "(not set)");
}

std::string refusal_of_switches(const Texts& arguments) {
    try {
        (void)apply_gdal_switches(arguments);
    } catch (const OptionError& error) {
        return error.what();
    }
    return "(not refused)";
}

TEST(GdalSwitches, leaveAllElseAsItWas) {
    const Texts arguments{"-lod", "4", "a.tif", "", "-fl", "-1", "b.gpkg"};
    EXPECT_EQ(apply_gdal_switches(arguments), arguments);
    EXPECT_EQ(apply_gdal_switches({}), Texts{});
}

TEST(GdalSwitches, setConfigurationOptionsInBothForms) {
    EXPECT_EQ(apply_gdal_switches({"-q", "--config", "D2B_ONE", "1", "x"}), (Texts{"-q", "x"}));
    EXPECT_EQ(gdal_config("D2B_ONE"), "1");
    EXPECT_EQ(apply_gdal_switches({"--config", "D2B_TWO=2", "-q", "x"}), (Texts{"-q", "x"}));
    EXPECT_EQ(gdal_config("D2B_TWO"), "2");
    EXPECT_EQ(apply_gdal_switches({"--config", "D2B_THREE=a=b", "--config", "D2B_FOUR", "c=d"}), Texts{});
    EXPECT_EQ(gdal_config("D2B_THREE"), "a=b");
    EXPECT_EQ(gdal_config("D2B_FOUR"), "c=d");
    EXPECT_EQ(apply_gdal_switches({"--config", "D2B_TWO="}), Texts{});
    EXPECT_EQ(gdal_config("D2B_TWO"), "");
}

TEST(GdalSwitches, leaveOurVersionAndWhatFollowsTwoDashes) {
    EXPECT_EQ(apply_gdal_switches({"--version"}), Texts{"-version"});
    EXPECT_EQ(apply_gdal_switches({"a", "--", "--config", "--version"}),
              (Texts{"a", "--", "--config", "--version"}));
}

TEST(GdalSwitches, readArgumentsFromAFile) {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("d2b_optfile_" + std::to_string(getpid()) + ".txt");
    std::ofstream(path) << "# comment\n-lod 7\n-q\n";
    EXPECT_EQ(apply_gdal_switches({"--optfile", path.string(), "a.tif"}),
              (Texts{"-lod", "7", "-q", "a.tif"}));
    std::filesystem::remove(path);
}

TEST(GdalSwitches, printAndAreDone) {
    for (const Texts& arguments :
         {Texts{"--formats"}, {"--format", "GTiff"}, {"--help-general"}, {"--build"}}) {
        testing::internal::CaptureStdout();
        const auto left = apply_gdal_switches(arguments);
        std::fflush(stdout);
        EXPECT_FALSE(left.has_value()) << arguments[0];
        EXPECT_NE(testing::internal::GetCapturedStdout(), "") << arguments[0];
    }
}

TEST(GdalSwitches, listFormatsOfRastersAndVectors) {
    testing::internal::CaptureStdout();
    (void)apply_gdal_switches({"--formats"});
    std::fflush(stdout);
    const std::string text = testing::internal::GetCapturedStdout();
    EXPECT_NE(text.find("GTiff"), std::string::npos);
    EXPECT_NE(text.find("GPKG"), std::string::npos);
    EXPECT_NE(text.find("ESRI Shapefile"), std::string::npos);
}

TEST(GdalSwitches, refuseWithTheReasonOfGdal) {
    EXPECT_EQ(refusal_of_switches({"--config", "A"}),
              "--config option given without a key and value argument.");
    EXPECT_EQ(refusal_of_switches({"--debug"}), "--debug option given without debug level.");
    EXPECT_TRUE(refusal_of_switches({"--optfile", "/nonexistent"}).starts_with("Unable to open optfile"));
    EXPECT_TRUE(
        refusal_of_switches({"--format", "XX"}).starts_with("--format option given with format 'XX'"));
}

TEST(GdalSwitches, knowTheVersionOfGdal) {
    int major = 0;
    int minor = 0;
    ASSERT_EQ(std::sscanf(gdal_version().c_str(), "%d.%d.", &major, &minor), 2) << gdal_version();
    EXPECT_TRUE(major > 3 || (major == 3 && minor >= 6)) << gdal_version();
}

}  // namespace
}  // namespace d2b::test
