#include "options/option_checks.hpp"

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"

namespace d2b::test {
namespace {

/// Options of a program that sets fields, not names.
std::string refusal(const Options& options) {
    try {
        check_options({options, {}});
    } catch (const OptionError& error) {
        return error.what();
    }
    return "(not refused)";
}

TEST(OptionChecks, AnOffsetIsWhereIntervalsCanBeCountedFrom) {
    Options options;
    options.levels.interval = 1;
    options.levels.offset = 1e300;
    EXPECT_EQ(refusal(options),
              "-off 1e+300 is too far away to count intervals of 1 from; give a base near the elevations.");
    options.levels.offset = -1e13;
    EXPECT_EQ(refusal(options),
              "-off -10000000000000 is too far away to count intervals of 1 from; give a base near the "
              "elevations.");
    options.levels.offset = -8e12;
    EXPECT_EQ(refusal(options), "(not refused)");
    options.levels.interval = 0.5;
    EXPECT_NE(refusal(options), "(not refused)");
    options.levels.offset = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(refusal(options), "(not refused)");
}

TEST(OptionChecks, ThesisRefusesFieldsOfWhatLooksForBuildings) {
    using Change = std::function<void(Options&)>;
    const std::vector<std::pair<std::string, Change>> changes{
        {"-ground auto", [](Options& o) { o.ground.mode = GroundMode::automatic; }},
        {"-ground dtm.tif",
         [](Options& o) {
             o.ground.mode = GroundMode::given;
             o.ground.terrain = "dtm.tif";
         }},
        {"-max_building_width", [](Options& o) { o.ground.max_building_width = 80; }},
        {"-levels building", [](Options& o) { o.levels.source = LevelSource::building; }},
        {"-levels natural", [](Options& o) { o.levels.source = LevelSource::natural; }},
        {"-detail 1", [](Options& o) { o.levels.detail = 1; }},
        {"-mask", [](Options& o) { o.detect.mask = "m.tif"; }},
        {"-ndvi", [](Options& o) { o.detect.ndvi = "n.tif"; }},
        {"-split_height 2", [](Options& o) { o.detect.split_height = 2; }},
        {"-split_by", [](Options& o) { o.detect.split_by = "p.gpkg"; }},
        {"-min_height", [](Options& o) { o.detect.min_height = 3; }},
        {"-min_confidence", [](Options& o) { o.detect.min_confidence = 0.4; }},
        {"-write_doubtful", [](Options& o) { o.write.doubtful = true; }},
        {"-write_ground", [](Options& o) { o.write.ground = "g.tif"; }},
        {"-write_height", [](Options& o) { o.write.height = "h.tif"; }},
        {"-write_canopy", [](Options& o) { o.write.canopy = "c.tif"; }}};
    for (const auto& [name, change] : changes) {
        Options options;
        options.preset = Preset::thesis;
        change(options);
        EXPECT_EQ(
            refusal(options),
            name + " has no effect with -preset thesis; it detects no buildings, so leave one of them out.");
        options.preset = Preset::buildings;
        EXPECT_EQ(refusal(options), "(not refused)") << name;
    }
}

/// The default of an option is refused like any other value of it, where it was given by name.
TEST(OptionChecks, WhatIsGivenByNameIsKnown) {
    const std::vector<std::string> two{"2"};
    Request request;
    request.options.preset = Preset::thesis;
    request.options.detect.min_height = 2;
    EXPECT_NO_THROW(check_options(request));
    apply_option(*find_option("min_height"), request, two);
    EXPECT_THROW(check_options(request), OptionError);
    // A run sees the options alone.
    EXPECT_NE(refusal(request.options), "(not refused)");
}

TEST(OptionChecks, RulesHoldForFieldsToo) {
    Options options;
    options.outline.simplify = 0.5;
    options.outline.walls = Walls::off;
    EXPECT_EQ(refusal(options), "(not refused)");
    options.outline.walls = Walls::right;
    EXPECT_EQ(refusal(options),
              "-simplify 0.5 cannot be used together with -regularize right; straight walls need no "
              "simplification.");
    options = {};
    options.levels.fixed = {5};
    options.levels.interval = 5;
    EXPECT_EQ(refusal(options), "-fl cannot be used together with -i; list the levels or give an interval.");
    options = {};
    options.levels.offset = 5;
    EXPECT_EQ(refusal(options),
              "-off needs -i <interval>; it is the elevation that the intervals count from.");
}

}  // namespace
}  // namespace d2b::test
