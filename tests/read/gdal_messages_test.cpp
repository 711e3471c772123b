#include "read/gdal_messages.hpp"

#include <algorithm>
#include <span>
#include <string_view>
#include <thread>

#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gtest/gtest.h>

#include "dem2buildings/open_sources.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_setup.hpp"

namespace d2b::reading {
namespace {

void say(CPLErr level, const std::string& text) {
    CPLError(level, CPLE_AppDefined, "%s", text.c_str());
}

TEST(GdalMessages, theLastErrorIsTheReason) {
    const GdalMessages messages;
    EXPECT_FALSE(messages.failed());
    EXPECT_EQ(messages.reason(), "GDAL gives no reason");
    say(CE_Failure, "first");
    say(CE_Failure, "second,\n  in two lines.\n");
    say(CE_Warning, "a warning");
    EXPECT_TRUE(messages.failed());
    EXPECT_EQ(messages.reason(), "second, in two lines");
}

TEST(GdalMessages, warningsAloneAreNoFailure) {
    const GdalMessages messages;
    say(CE_Warning, "one");
    say(CE_Warning, "two");
    say(CE_Warning, "one");
    EXPECT_FALSE(messages.failed());
    EXPECT_EQ(messages.warnings(), (std::vector<std::string>{"one", "two"}));
}

TEST(GdalMessages, innerScopesKeepTheirMessages) {
    const GdalMessages outer;
    {
        const GdalMessages inner;
        say(CE_Failure, "inner");
        EXPECT_EQ(inner.reason(), "inner");
    }
    EXPECT_FALSE(outer.failed());
    say(CE_Failure, "outer");
    EXPECT_EQ(outer.reason(), "outer");
}

TEST(GdalMessages, hiddenNamesAreNotShown) {
    const GdalMessages messages("/tmp/dem2buildings_x1", "/vsistdin/");
    say(CE_Warning, "/tmp/dem2buildings_x1: odd tag");
    say(CE_Failure, "`/tmp/dem2buildings_x1' is not /tmp/dem2buildings_x1");
    EXPECT_EQ(messages.warnings(), (std::vector<std::string>{"/vsistdin/: odd tag"}));
    EXPECT_EQ(messages.reason(), "`/vsistdin/' is not /vsistdin/");
    const GdalMessages folder("./.dem2buildings.x/", "");
    say(CE_Failure, "dataset ./.dem2buildings.x/o.gpkg has no option");
    EXPECT_EQ(folder.reason(), "dataset o.gpkg has no option");
}

TEST(GdalMessages, aWarningIsPassedOnce) {
    std::vector<std::string> heard;
    Warnings warnings([&](const std::string& text) { heard.push_back(text); });
    for (int i = 0; i < 2; ++i) {
        const GdalMessages messages;
        say(CE_Warning, "odd.");
        say(CE_Failure, "an error");
        messages.pass_warnings(warnings);
    }
    EXPECT_EQ(heard, (std::vector<std::string>{"GDAL: odd."}));
}

TEST(GdalMessages, errorsOfACallThatSucceededArePassedAsWarnings) {
    std::vector<std::string> heard;
    Warnings warnings([&](const std::string& text) { heard.push_back(text); });
    const GdalMessages messages;
    say(CE_Failure, "an error");
    say(CE_Warning, "odd");
    messages.pass_all(warnings);
    EXPECT_EQ(heard, (std::vector<std::string>{"GDAL: odd.", "GDAL: an error."}));
}

TEST(GdalMessages, aFloodOfWarningsIsCut) {
    std::vector<std::string> heard;
    Warnings warnings([&](const std::string& text) { heard.push_back(text); });
    for (int call = 0; call < 3; ++call) {
        const GdalMessages messages;
        for (int i = 0; i < 15; ++i)
            say(CE_Warning, "block " + std::to_string(100 * call + i));
        messages.pass_warnings(warnings);
    }
    ASSERT_EQ(heard.size(), 21U);
    EXPECT_EQ(heard[19], "GDAL: block 104.");
    EXPECT_EQ(heard[20], "GDAL: further warnings are left out.");
}

TEST(GdalMessages, namesAFileSystemThatGdalWasBuiltWithout) {
    start_gdal();
    EXPECT_EQ(missing_file_system("town.tif"), "");
    EXPECT_EQ(missing_file_system("/vsimem/town.tif"), "");
    const CPLStringList prefixes(VSIGetFileSystemsPrefixes());
    const std::span known(prefixes.List(), static_cast<std::size_t>(prefixes.Count()));
    for (const std::string prefix : remote_prefixes) {
        const std::string name = "/vsizip/" + prefix + "/server/town.zip";
        const bool there = std::ranges::any_of(
            known, [&](const char* system) { return std::string_view(system).starts_with(prefix); });
        const GdalMessages messages;
        say(CE_Failure, "does not exist");
        EXPECT_EQ(missing_file_system(name).empty(), there) << name;
        EXPECT_EQ(
            messages.reason_for(name),
            there ? "does not exist" : "this program was built without " + prefix + "/; download the file");
    }
}

TEST(GdalMessages, linesAreCleaned) {
    EXPECT_EQ(one_line("  a\t\tb\r\n c . "), "a b c");
    EXPECT_EQ(one_line(""), "");
    EXPECT_EQ(one_line(std::string(600, 'x')), std::string(500, 'x') + "...");
    // The umlaut of two bytes would be cut in two.
    EXPECT_EQ(one_line(std::string(499, 'x') + "\xc3\xa4" + "yyy"), std::string(499, 'x') + "...");
}

TEST(StartGdal, gdalIsSilentByItself) {
    ::testing::internal::CaptureStderr();
    start_gdal();
    start_gdal();
    say(CE_Failure, "in the main thread");
    std::thread([] { say(CE_Warning, "in another"); }).join();
    {
        const GdalMessages messages;
        say(CE_Warning, "within a scope");
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace d2b::reading
