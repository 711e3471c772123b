#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings/options.hpp"

namespace d2b {
namespace {

std::string refusal(const std::string& name, const std::vector<std::string>& values) {
    Options options;
    try {
        set_option(options, name, values);
    } catch (const OptionError& error) {
        return error.what();
    }
    return "no exception";
}

TEST(SetOption, TakesTheNamesAndValuesOfTheCommandLine) {
    Options options;
    set_option(options, "lod", {"3"});
    set_option(options, "-min_area", {"50.5"});
    set_option(options, "disjoint");
    set_option(options, "srcwin", {"1", "2", "30", "40"});
    set_option(options, "threads", {"2"});
    EXPECT_EQ(options.levels.lod, 3);
    EXPECT_EQ(options.filter.min_area_m2, 50.5);
    EXPECT_TRUE(options.outline.disjoint);
    EXPECT_EQ(options.read.source_window, (std::array<double, 4>{1, 2, 30, 40}));
    EXPECT_EQ(options.run.threads, 2);
}

TEST(SetOption, RefusesWhatTheTableRefuses) {
    EXPECT_EQ(refusal("nonesuch", {"1"}), "There is no option 'nonesuch'; docs/options.md lists all.");
    EXPECT_NE(refusal("lod", {"many"}).find("-lod must be"), std::string::npos);
    EXPECT_EQ(refusal("disjoint", {"1"}), "-disjoint takes no value.");
    EXPECT_EQ(refusal("json", {}), "-json is of the program alone; leave it out.");
    EXPECT_EQ(refusal("sweep", {"lod=1..3"}), "-sweep is of the program alone; leave it out.");
}

/// What was set before stays where the next is refused.
TEST(SetOption, LeavesOptionsAsTheyWereWhereItRefuses) {
    Options options;
    set_option(options, "lod", {"3"});
    EXPECT_THROW(set_option(options, "lod", {"0.5"}), OptionError);
    EXPECT_EQ(options.levels.lod, 3);
    EXPECT_EQ(options.given.count("lod"), 1U);
}

}  // namespace
}  // namespace d2b
