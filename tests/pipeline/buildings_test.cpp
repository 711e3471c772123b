#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "pipeline/made_town.hpp"

namespace d2b {
namespace {

using test::Box;
using test::buildings;
using test::contours;
using test::MadeTown;
using test::TownRun;

TEST(Buildings, AreFoundAndTreesAreNot) {
    TownRun town;
    town.run();
    ASSERT_TRUE(town.sink.finished);
    EXPECT_EQ(town.count(), 3U);
    for (const Box& box : {MadeTown::flat, MadeTown::gabled, MadeTown::podium}) {
        const std::size_t i = town.at(box, buildings, 0.97);
        EXPECT_NEAR(town.sink.number(buildings, i, "area_m2"), box.area(), 0.03 * box.area());
        EXPECT_GE(town.sink.number(buildings, i, "confidence"), 0.5);
        EXPECT_EQ(town.sink.number(buildings, i, "nodata"), 0);
        // A cell may be missing in a corner; walls are straight all the same.
        EXPECT_LE(town.sink.features[buildings][i].parts[0].exterior.size(), 8U);
        EXPECT_LE(town.sink.number(buildings, i, "moved_m"), 1.5);
    }
    EXPECT_EQ(town.report.buildings, 3);
    EXPECT_TRUE(town.report.warnings.empty());
}

TEST(Buildings, StandOnTheGroundAndHaveTheirHeights) {
    TownRun town;
    town.run();
    const auto check = [&](const Box& box, double height, double median, double tolerance) {
        const std::size_t i = town.at(box);
        // A tenth of the way from the low corner of the slope to the high one.
        const double low = MadeTown::ground(box.row, box.col);
        const double ground = town.sink.number(buildings, i, "ground");
        EXPECT_GT(ground, low - 0.2);
        EXPECT_LT(ground, MadeTown::middle(box));
        EXPECT_NEAR(town.sink.number(buildings, i, "roof"), MadeTown::middle(box) + height, 0.1);
        EXPECT_NEAR(town.sink.number(buildings, i, "height"), MadeTown::middle(box) + height - ground, 0.1);
        EXPECT_NEAR(town.sink.number(buildings, i, "p50"), MadeTown::middle(box) + median - ground,
                    tolerance);
    };
    check(MadeTown::flat, MadeTown::flat_height, MadeTown::flat_height, 0.1);
    check(MadeTown::gabled, MadeTown::ridge - 1 / 3.0, (MadeTown::ridge + MadeTown::eaves) / 2,
          0.5);  // between two rows of cells
    check(MadeTown::podium, MadeTown::tower_height, MadeTown::podium_height, 0.1);
}

TEST(Buildings, HaveTheVolumeOfWhatStandsThere) {
    TownRun town;
    town.run();
    const std::size_t i = town.at(MadeTown::podium);
    const double above = MadeTown::middle(MadeTown::podium) - town.sink.number(buildings, i, "ground");
    const double volume = MadeTown::podium.area() * (MadeTown::podium_height + above) +
                          MadeTown::tower.area() * (MadeTown::tower_height - MadeTown::podium_height);
    EXPECT_NEAR(town.sink.number(buildings, i, "volume_m3"), volume, 0.03 * volume);
}

/// Mean and sample deviation of a podium's points with a tower on it, without noise.
struct PodiumMoments {
    double share = MadeTown::tower.area() / MadeTown::podium.area();
    double step = MadeTown::tower_height - MadeTown::podium_height;
    double base = MadeTown::middle(MadeTown::podium) + MadeTown::podium_height;
    double mean = base + share * step;
    double deviation = step * std::sqrt(share * (1 - share));
};

TEST(Buildings, TiersAreSlicesOfTheirOwnElevations) {
    TownRun town;
    town.options.levels.source = LevelSource::building;
    town.options.levels.detail = 0;
    town.run();
    const PodiumMoments m;
    std::vector<double> expected;
    for (int i = 1; i <= 4; ++i)
        if (const double t = m.mean - m.deviation + 2 * m.deviation * i / 5; t > m.base)
            expected.push_back(t);
    const auto id = town.sink.whole(buildings, town.at(MadeTown::podium), "id");
    std::vector<std::size_t> tiers;
    for (std::size_t i = 0; i < town.count(contours); ++i)
        if (town.sink.whole(contours, i, "bldg_id") == id && town.sink.whole(contours, i, "level") > 1)
            tiers.push_back(i);
    ASSERT_EQ(tiers.size(), expected.size());
    for (std::size_t i = 0; i < tiers.size(); ++i) {
        EXPECT_NEAR(town.sink.number(contours, tiers[i], "threshold"), expected[i], 0.3);
        EXPECT_GE(overlap(town.sink.features[contours][tiers[i]], MadeTown::tower, town.dem.info().transform),
                  0.97);
        const std::size_t below = i == 0 ? town.at(MadeTown::podium, contours) : tiers[i - 1];
        EXPECT_EQ(town.sink.whole(contours, tiers[i], "parent_id"), town.sink.whole(contours, below, "id"));
        EXPECT_LE(town.sink.number(contours, tiers[i], "area_m2"),
                  town.sink.number(contours, below, "area_m2"));
    }
    EXPECT_NEAR(town.sink.number(contours, tiers.back(), "top"),
                MadeTown::middle(MadeTown::podium) + MadeTown::tower_height, 0.1);
}

TEST(Buildings, ContoursHaveNoRoot) {
    TownRun town;
    town.run();
    std::size_t footprints = 0;
    for (std::size_t i = 0; i < town.count(contours); ++i) {
        const auto level = town.sink.whole(contours, i, "level");
        EXPECT_GE(level, 1);
        if (level != 1)
            continue;
        ++footprints;
        EXPECT_EQ(town.sink.value(contours, i, "parent_id"), FieldValue{});
        const auto building = static_cast<std::size_t>(town.sink.whole(contours, i, "bldg_id")) - 1;
        EXPECT_EQ(town.sink.value(contours, i, "threshold"), town.sink.value(buildings, building, "ground"));
        EXPECT_EQ(town.sink.value(contours, i, "base"), town.sink.value(buildings, building, "ground"));
    }
    EXPECT_EQ(footprints, 3U);
    const auto& levels = town.report.levels;
    EXPECT_EQ(levels[0].contours, 0);
    EXPECT_TRUE(std::isnan(levels[1].threshold));  // each building has its own
    EXPECT_EQ(levels[1].contours, 3);
}

TEST(Buildings, FlatRoofsHaveNoTiers) {
    TownRun town;
    town.run();
    const std::size_t i = town.at(MadeTown::flat);
    EXPECT_EQ(town.sink.whole(buildings, i, "n_parts"), 1);
    EXPECT_EQ(town.sink.whole(buildings, i, "has_parts"), 0);
    EXPECT_LT(town.report.stack_rmse_m, 1.5);
    EXPECT_GT(town.report.stack_rmse_m, 0);
}

/// Whether the middle of a cell lies in a feature, or on the left of its borders.
bool holds(const Feature& feature, const Position& middle) {
    bool inside = false;
    const auto pass = [&](const WorldRing& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Position& a = ring[i];
            const Position& b = ring[(i + 1) % ring.size()];
            if ((a.y > middle.y) != (b.y > middle.y) &&
                middle.x < a.x + (b.x - a.x) * (middle.y - a.y) / (b.y - a.y))
                inside = !inside;
        }
    };
    for (const WorldPolygon& part : feature.parts) {
        pass(part.exterior);
        std::ranges::for_each(part.interiors, pass);
    }
    return inside;
}

/// The stack against the town, cell by cell, from what was written alone.
double rmse_as_written(const TownRun& town, const std::vector<double>& z) {
    double squares = 0;
    double cells = 0;
    for (int row = 0; row < MadeTown::rows; ++row)
        for (int col = 0; col < MadeTown::cols; ++col) {
            const AffineTransform& t = town.dem.info().transform;
            const Position middle{t[0] + (col + 0.5) * t[1], t[3] + (row + 0.5) * t[5]};
            const auto in = [&](const Feature& feature) { return holds(feature, middle); };
            double tier = std::numeric_limits<double>::quiet_NaN();
            if (std::ranges::any_of(town.sink.features[buildings], in))
                for (std::size_t i = 0; i < town.count(contours); ++i)  // from low to high
                    if (town.sink.value(contours, i, "tier_z") != FieldValue{} &&
                        in(town.sink.features[contours][i]))
                        tier = town.sink.number(contours, i, "tier_z");
            if (std::isnan(tier))
                continue;
            squares += std::pow(tier - z[MadeTown::index(row, col)], 2);
            ++cells;
        }
    return std::sqrt(squares / cells);
}

TEST(Buildings, TheStackIsMeasuredAsItIsWritten) {
    const std::vector<double> z = MadeTown::surface();
    TownRun town(z);
    town.run();
    EXPECT_NEAR(town.report.stack_rmse_m, rmse_as_written(town, z), 1e-6);
    for (const auto& change :
         std::vector<std::function<void(Options&)>>{[](Options& o) { o.outline.walls = Walls::off; },
                                                    [](Options& o) {
                                                        o.outline.walls = Walls::off;
                                                        o.outline.simplify = 2;
                                                    },
                                                    [](Options& o) { o.outline.disjoint = true; }}) {
        TownRun other(z);
        change(other.options);
        other.run();
        EXPECT_NEAR(other.report.stack_rmse_m, rmse_as_written(other, z), 1e-6);
    }
    TownRun alone(z);
    alone.options.write.layers = Layers::contours;
    alone.options.run.threads = 3;
    alone.run();
    EXPECT_NEAR(alone.report.stack_rmse_m, town.report.stack_rmse_m, 0.1 * town.report.stack_rmse_m);
}

TEST(Buildings, GlobalLevelsAreOneSetForAll) {
    TownRun town;
    town.options.levels.source = LevelSource::global;
    town.options.levels.lod = 1;  // the mean of all elevations
    town.run();
    const double mean = town.report.mean;
    for (std::size_t i = 0; i < town.count(contours); ++i)
        if (town.sink.whole(contours, i, "level") > 1) {
            EXPECT_EQ(town.sink.number(contours, i, "threshold"), mean);
        }
    TownRun fixed;
    fixed.options.levels.fixed = {115.5};
    fixed.run();
    ASSERT_EQ(fixed.count(contours), 4U);  // three footprints and the tower
    EXPECT_EQ(fixed.sink.number(contours, 3, "threshold"), 115.5);
    EXPECT_GE(overlap(fixed.sink.features[contours][3], MadeTown::tower, fixed.dem.info().transform), 0.97);
}

TEST(Buildings, DisjointBandsAddUpToTheFootprints) {
    TownRun town;
    town.options.outline.disjoint = true;
    town.run();
    TownRun stacked;
    stacked.run();
    double bands = 0;
    double whole = 0;
    for (std::size_t i = 0; i < town.count(contours); ++i)
        bands += town.sink.number(contours, i, "area_m2");
    for (std::size_t i = 0; i < stacked.count(contours); ++i)
        if (stacked.sink.whole(contours, i, "level") == 1)
            whole += stacked.sink.number(contours, i, "area_m2");
    EXPECT_NEAR(bands, whole, 1e-6 * whole);
    EXPECT_EQ(town.report.counted(Reason::polygon_repaired), 0);
}

TEST(Buildings, SplitWhereTheRoofSteps) {
    TownRun town;
    town.options.detect.split_height = 5;
    town.run();
    ASSERT_EQ(town.count(), 4U);
    const std::size_t tower = town.at(MadeTown::tower, buildings, 0.9);
    EXPECT_NEAR(town.sink.number(buildings, tower, "roof"),
                MadeTown::middle(MadeTown::podium) + MadeTown::tower_height, 0.1);
    double area = 0;
    for (std::size_t i = 0; i < town.count(); ++i)
        area += town.sink.number(buildings, i, "area_m2");
    const double expected = MadeTown::flat.area() + MadeTown::gabled.area() + MadeTown::podium.area();
    EXPECT_NEAR(area, expected, 0.03 * expected);  // the parts share their wall
}

TEST(Buildings, SmallOnesAreLeftOut) {
    TownRun town;
    town.options.filter.min_area_m2 = 255;  // the flat house has 252 m2, the gabled one 264
    town.run();
    EXPECT_EQ(town.count(), 2U);
    town.at(MadeTown::gabled);
    town.at(MadeTown::podium);
}

TEST(Buildings, LowOnesAreLeftOut) {
    TownRun town;
    town.options.detect.min_height = 12;
    town.run();
    EXPECT_EQ(town.count(), 1U);
    town.at(MadeTown::tower);  // what rises above it
}

TEST(Buildings, SayHowTheyWereFound) {
    TownRun town;
    town.options.detect.min_height = 2.5;
    town.run();
    const auto& metadata = town.sink.provenance.metadata;
    EXPECT_EQ(metadata.at("D2B_PRESET"), "buildings");
    EXPECT_EQ(metadata.at("D2B_GROUND"), "auto");
    EXPECT_EQ(metadata.at("D2B_MIN_HEIGHT_M"), "2.5");
    EXPECT_EQ(metadata.at("D2B_MIN_AREA_M2"), "30");
    EXPECT_EQ(metadata.at("D2B_MIN_CONFIDENCE"), "0.5");
    EXPECT_EQ(metadata.at("D2B_LEVELS"), "natural");
    EXPECT_EQ(metadata.at("D2B_DETAIL_M"), "0.5");
    EXPECT_EQ(metadata.at("D2B_LOD"), "4");
    EXPECT_EQ(metadata.at("D2B_REGULARIZE"), "auto");
    EXPECT_EQ(metadata.at("D2B_TRACE"), "cells");
    EXPECT_EQ(metadata.at("D2B_OPTIONS"), "-min_height 2.5");
    EXPECT_FALSE(metadata.contains("D2B_THRESHOLDS"));  // each building has its own
}

TEST(Buildings, SayNothingOfOptionsWithoutEffect) {
    TownRun town;
    town.options.levels.fixed = {4};
    town.options.ground.mode = GroundMode::none;
    town.run();
    const auto& metadata = town.sink.provenance.metadata;
    EXPECT_EQ(metadata.at("D2B_OPTIONS"), "-ground none -fl 4");
    for (const char* name : {"D2B_LOD", "D2B_LEVELS", "D2B_MAX_BUILDING_WIDTH_M", "D2B_MASK"})
        EXPECT_FALSE(metadata.contains(name)) << name;
}

}  // namespace
}  // namespace d2b
