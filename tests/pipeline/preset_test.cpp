#include "options/preset.hpp"

#include <functional>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

Options of(const std::string& preset) {
    Options options;
    options.preset = preset;
    return options;
}

std::string refusal(const Options& options) {
    try {
        static_cast<void>(with_preset(options));
    } catch (const OptionError& error) {
        return error.what();
    }
    return "(not refused)";
}

TEST(Preset, BuildingsIsTheDefault) {
    EXPECT_TRUE(detects_buildings(Options{}));
    EXPECT_FALSE(detects_buildings(of("thesis")));
}

TEST(Preset, WhatIsUnknownIsRefused) {
    for (const char* preset : {"", "building", "Thesis", "thesis "})
        EXPECT_EQ(refusal(of(preset)),
                  "There is no preset '" + std::string(preset) + "'; choose buildings or thesis.");
}

TEST(Preset, AnOffsetIsWhereIntervalsCanBeCountedFrom) {
    Options options;
    options.levels.offset = 1e300;
    EXPECT_EQ(refusal(options), "(not refused)");  // it has no meaning without an interval
    options.levels.interval = 1;
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

TEST(Preset, BuildingsDecidesWhatIsNotGiven) {
    const Options options = with_preset(of("buildings"));
    EXPECT_EQ(options.ground.mode, GroundMode::automatic);
    EXPECT_EQ(options.levels.source, LevelSource::building);
    EXPECT_EQ(options.trace.mode, TraceMode::cells);
    EXPECT_EQ(options.outline.walls, Walls::automatic);
    EXPECT_EQ(options.detect.min_area_m2, 30);
    EXPECT_EQ(options.filter.min_area_m2, 0);  // tiers may be smaller
    EXPECT_TRUE(options.filter.keep_footprints);
}

TEST(Preset, ThesisDecidesWhatIsNotGiven) {
    const Options options = with_preset(of("thesis"));
    EXPECT_EQ(options.ground.mode, GroundMode::none);
    EXPECT_EQ(options.levels.source, LevelSource::global);
    EXPECT_EQ(options.trace.mode, TraceMode::points);
    EXPECT_EQ(options.outline.walls, Walls::off);
    EXPECT_EQ(options.filter.min_area_m2, 0);
    EXPECT_FALSE(options.filter.keep_footprints);
}

TEST(Preset, WhatIsGivenStays) {
    Options options = of("buildings");
    options.ground.mode = GroundMode::given;
    options.levels.source = LevelSource::global;
    options.trace.mode = TraceMode::points;
    options.outline.walls = Walls::right;
    options.filter.min_area_m2 = 12;
    options = with_preset(options);
    EXPECT_EQ(options.ground.mode, GroundMode::given);
    EXPECT_EQ(options.levels.source, LevelSource::global);
    EXPECT_EQ(options.trace.mode, TraceMode::points);
    EXPECT_EQ(options.outline.walls, Walls::right);
    EXPECT_EQ(options.detect.min_area_m2, 12);
    EXPECT_EQ(options.filter.min_area_m2, 0);

    options = of("thesis");
    options.ground.mode = GroundMode::none;
    options.trace.mode = TraceMode::cells;
    options.outline.walls = Walls::free;
    options.filter.min_area_m2 = 12;
    options = with_preset(options);
    EXPECT_EQ(options.trace.mode, TraceMode::cells);
    EXPECT_EQ(options.outline.walls, Walls::free);
    EXPECT_EQ(options.filter.min_area_m2, 12);
}

/// A tool asks for it before it opens files, and the run again.
TEST(Preset, DoneAgainChangesNothing) {
    for (const std::optional<double> min_area : {std::optional<double>(), std::optional<double>(12)})
        for (const double simplify : {0.0, 0.5})
            for (const char* preset : {"buildings", "thesis"}) {
                Options given = of(preset);
                given.filter.min_area_m2 = min_area;
                given.outline.simplify = simplify;
                const Options once = with_preset(given);
                const Options twice = with_preset(once);
                EXPECT_EQ(twice.detect.min_area_m2, once.detect.min_area_m2);
                EXPECT_EQ(twice.filter.min_area_m2, once.filter.min_area_m2);
                EXPECT_EQ(twice.filter.keep_footprints, once.filter.keep_footprints);
                EXPECT_EQ(twice.ground.mode, once.ground.mode);
                EXPECT_EQ(twice.levels.source, once.levels.source);
                EXPECT_EQ(twice.trace.mode, once.trace.mode);
                EXPECT_EQ(twice.outline.walls, once.outline.walls);
            }
}

TEST(Preset, SimplifiedOutlinesHaveNoStraightWalls) {
    Options options = of("buildings");
    options.outline.simplify = 0.5;
    EXPECT_EQ(with_preset(options).outline.walls, Walls::off);
    options.outline.walls = Walls::off;
    EXPECT_EQ(with_preset(options).outline.walls, Walls::off);
    for (const Walls walls : {Walls::automatic, Walls::right, Walls::free})
        for (const char* preset : {"buildings", "thesis"}) {
            options.preset = preset;
            options.outline.walls = walls;
            EXPECT_EQ(refusal(options),
                      "-simplify cannot be used together with -regularize; straight walls need no "
                      "simplification.");
        }
}

/// A format that holds one layer gets the buildings alone.
TEST(Preset, RefusesWhatStandsInLayersThatAreNotWritten) {
    Options options = of("buildings");
    options.outline.disjoint = true;
    for (const Layers layers : {Layers::automatic, Layers::both, Layers::contours}) {
        options.write.layers = layers;
        EXPECT_EQ(refusal(options), "(not refused)");
    }
    options.write.layers = Layers::buildings;
    EXPECT_EQ(
        refusal(options),
        "-disjoint has no effect where the buildings alone are written; use -layers contours, or a format "
        "that holds both layers, such as GeoPackage.");
    options = of("buildings");
    options.write.fields = FieldNames::osm;
    options.write.layers = Layers::contours;
    EXPECT_EQ(
        refusal(options),
        "-fields has no effect where the contours alone are written; only fields of buildings have other "
        "names.");
    options.write.doubtful = true;
    EXPECT_EQ(refusal(options), "(not refused)");
}

TEST(Preset, ThesisRefusesWhatLooksForBuildings) {
    using Change = std::function<void(Options&)>;
    const std::vector<std::pair<std::string, Change>> changes{
        {"-ground", [](Options& o) { o.ground.mode = GroundMode::automatic; }},
        {"-ground", [](Options& o) { o.ground.mode = GroundMode::given; }},
        {"-max_building_width", [](Options& o) { o.ground.max_building_width = 80; }},
        {"-levels building", [](Options& o) { o.levels.source = LevelSource::building; }},
        {"-levels natural", [](Options& o) { o.levels.source = LevelSource::natural; }},
        {"-detail", [](Options& o) { o.levels.detail = 1; }},
        {"-mask", [](Options& o) { o.detect.mask = "m.tif"; }},
        {"-ndvi", [](Options& o) { o.detect.ndvi = "n.tif"; }},
        {"-split_height", [](Options& o) { o.detect.split_height = 2; }},
        {"-min_height", [](Options& o) { o.detect.min_height = 3; }},
        {"-min_confidence", [](Options& o) { o.detect.min_confidence = 0.4; }},
        {"-write_doubtful", [](Options& o) { o.write.doubtful = true; }},
        {"-write_ground", [](Options& o) { o.write.ground = "g.tif"; }},
        {"-write_height", [](Options& o) { o.write.height = "h.tif"; }},
        {"-write_canopy", [](Options& o) { o.write.canopy = "c.tif"; }}};
    for (const auto& [name, change] : changes) {
        Options options = of("thesis");
        change(options);
        EXPECT_EQ(
            refusal(options),
            name + " has no effect with -preset thesis; it detects no buildings, so leave one of them out.");
        options.preset = "buildings";
        EXPECT_EQ(refusal(options), "(not refused)") << name;
    }
}

}  // namespace
}  // namespace d2b
