#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "options/option_table.hpp"
#include "pipeline/find_buildings.hpp"
#include "pipeline/made_town.hpp"
#include "pipeline/pipeline_case.hpp"

namespace d2b::test {
namespace {

TEST(SideRasters, GroundHeightAndCanopy) {
    TownRun town;
    town.run();
    const std::vector<double> z = MadeTown::surface();
    for (const auto* raster : {&town.ground, &town.height, &town.canopy}) {
        EXPECT_TRUE(raster->finished);
        EXPECT_EQ(raster->cells, MadeTown::rows * MadeTown::cols);
        ASSERT_EQ(raster->values.size(), z.size());
    }
    int trees = 0;
    for (int r = 0; r < MadeTown::rows; ++r)
        for (int c = 0; c < MadeTown::cols; ++c) {
            const std::size_t i = MadeTown::index(r, c);
            const double ground = static_cast<double>(town.ground.values[i]);
            const double height = static_cast<double>(town.height.values[i]);
            const double canopy = static_cast<double>(town.canopy.values[i]);
            const bool wood = MadeTown::wood.holds(r, c);
            const bool corner = std::ranges::any_of(
                std::array{MadeTown::flat, MadeTown::gabled, MadeTown::podium}, [&](const Box& box) {
                    return (r == box.row || r == box.row + box.rows - 1) &&
                           (c == box.col || c == box.col + box.cols - 1);
                });
            ASSERT_NEAR(ground, MadeTown::ground(r, c), wood ? 2.0 : 0.4) << r << " " << c;
            ASSERT_NEAR(height, z[i] - ground, 1e-4);
            ASSERT_GE(height, 0);
            if (wood && z[i] - MadeTown::ground(r, c) > 4) {
                ++trees;
                ASSERT_EQ(canopy, height);
            } else if (!wood && !corner) {
                ASSERT_EQ(canopy, 0) << r << " " << c;  // roofs and lawns
            }
        }
    EXPECT_GT(trees, 500);
}

TEST(SideRasters, AreNotFinishedWhereTheRunIsCancelled) {
    TownRun town;
    town.callbacks.on_progress = [](double share) { return share < 0.7; };
    EXPECT_THROW(town.run(), Cancelled);
    EXPECT_FALSE(town.ground.finished);
    EXPECT_FALSE(town.sink.finished);
}

TEST(Progress, NeverGoesBack) {
    for (const Preset preset : every_preset) {
        TownRun town;
        town.options.preset = preset;
        std::vector<double> shares;
        town.callbacks.on_progress = [&](double share) {
            shares.push_back(share);
            return true;
        };
        town.run();
        EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
        EXPECT_GT(shares.size(), 3U);
        EXPECT_GE(shares.front(), 0);
        EXPECT_EQ(shares.back(), 1);
    }
}

TEST(SideRasters, ElevationsAreThoseThatTheRunUses) {
    std::vector<double> z = MadeTown::surface();
    const std::size_t no_land = MadeTown::index(3, 3);
    const std::size_t spike = MadeTown::index(2, MadeTown::cols - 3);
    z[no_land] = -9999;
    z[spike] += 400;
    for (const Preset preset : every_preset) {
        TownRun town(z);
        town.options.preset = preset;
        MemoryRaster elevations;
        Sinks sinks{town.sink};
        sinks.elevations = &elevations;
        d2b::run(town.options, {town.dem}, sinks);
        EXPECT_TRUE(elevations.finished);
        ASSERT_EQ(elevations.values.size(), z.size());
        for (std::size_t i = 0; i < z.size(); ++i) {
            const bool none = i == no_land || (i == spike && preset == Preset::buildings);
            ASSERT_EQ(std::isnan(elevations.values[i]), none) << i;
            ASSERT_TRUE(none || elevations.values[i] == static_cast<float>(z[i])) << i;
        }
    }
}

TEST(SideRasters, ElevationsAreInMetres) {
    TownRun town;
    town.dem.edit().band_unit = "ft";
    MemoryRaster elevations;
    Sinks sinks{town.sink};
    sinks.elevations = &elevations;
    d2b::run(town.options, {town.dem}, sinks);
    EXPECT_NEAR(static_cast<double>(elevations.values[0]), MadeTown::surface()[0] * 0.3048, 1e-4);
}

TEST(SideRasters, HoldWhatIsNotKnown) {
    std::vector<double> z = MadeTown::surface();
    for (int r = 25; r < 28; ++r)
        for (int c = 25; c < 28; ++c)
            z[MadeTown::index(r, c)] = std::nan("");  // in the roof of the flat house
    for (int c = 0; c < MadeTown::cols; ++c)
        z[MadeTown::index(0, c)] = std::nan("");
    TownRun town(std::move(z));
    town.run();
    const std::size_t roof = MadeTown::index(26, 26);
    EXPECT_NEAR(static_cast<double>(town.ground.values[roof]), MadeTown::ground(26, 26), 0.4);
    EXPECT_TRUE(std::isnan(town.height.values[roof]));
    EXPECT_TRUE(std::isnan(town.canopy.values[roof]));
    const std::size_t i = town.at(MadeTown::flat, buildings, 0.95);  // whole all the same
    EXPECT_NEAR(town.sink.number(buildings, i, "nodata"), 9 / MadeTown::flat.area(), 0.003);
    EXPECT_EQ(town.sink.whole(buildings, i, "n_cells") - town.sink.whole(buildings, i, "n_points"), 9);
}

TEST(GivenTerrain, IsTheGround) {
    MemorySource terrain = MadeTown::source(MadeTown::terrain());
    TownRun town;
    town.options.ground.mode = GroundMode::given;
    town.terrain = &terrain;
    town.run();
    EXPECT_EQ(town.count(), 3U);
    for (int r = 0; r < MadeTown::rows; ++r)
        for (int c = 0; c < MadeTown::cols; ++c) {
            const double ground = static_cast<double>(town.ground.values[MadeTown::index(r, c)]);
            ASSERT_LE(ground, MadeTown::ground(r, c) + 1e-4);  // never above the surface,
            ASSERT_GE(ground, MadeTown::ground(r, c) - 0.04);  // which is off by 3 cm at most
        }
    // Along the border of the flat house, the tenth percentile of the slope.
    std::vector<double> border;
    const Box& box = MadeTown::flat;
    const auto edge = [&](int r, int c, int out_r, int out_c) {
        border.push_back(MadeTown::ground(r, c));
        border.push_back(MadeTown::ground(r + out_r, c + out_c));
    };
    for (int r = box.row; r < box.row + box.rows; ++r) {
        edge(r, box.col, 0, -1);
        edge(r, box.col + box.cols - 1, 0, 1);
    }
    for (int c = box.col; c < box.col + box.cols; ++c) {
        edge(box.row, c, -1, 0);
        edge(box.row + box.rows - 1, c, 1, 0);
    }
    std::ranges::sort(border);
    EXPECT_NEAR(town.sink.number(buildings, town.at(box), "ground"), border[border.size() / 10], 0.05);
}

TEST(GivenTerrain, WhereItKnowsNothingThereIsNothing) {
    std::vector<double> z = MadeTown::terrain();
    for (int r = 0; r < MadeTown::rows; ++r)
        for (int c = 0; c < 60; ++c)
            z[MadeTown::index(r, c)] = std::nan("");
    MemorySource terrain = MadeTown::source(std::move(z));
    TownRun town;
    town.options.ground.mode = GroundMode::given;
    town.terrain = &terrain;
    town.run();
    town.at(MadeTown::gabled);
    for (std::size_t i = 0; i < town.count(); ++i)
        EXPECT_EQ(overlap(town.sink.features[buildings][i], MadeTown::flat, town.dem.info().transform), 0);
    EXPECT_TRUE(std::isnan(town.height.values[0]));
}

TEST(BuildingMask, BoundsWhereBuildingsAreLookedFor) {
    MemorySource mask = MadeTown::source(MadeTown::in({MadeTown::gabled}, 1, 0));
    TownRun town;
    town.mask = &mask;
    town.run();
    EXPECT_EQ(town.count(), 1U);
    EXPECT_NEAR(town.sink.number(buildings, town.at(MadeTown::gabled), "area_m2"), MadeTown::gabled.area(),
                8);
    // The ground is that of the whole: the podium is no ground.
    EXPECT_NEAR(static_cast<double>(town.ground.values[MadeTown::index(90, 45)]), MadeTown::ground(90, 45),
                0.4);
}

constexpr std::uint8_t flag = 2;

/// Takes the cells 7 and 400 of 600 out of the view. @return the reader's values afterwards
std::vector<double> after_taking_out(double step, const Window& seen, double metres) {
    std::vector<double> z;
    for (int i = 0; i < 600; ++i)
        z.push_back(100 + step * i);
    MemorySource source(20, 30, z);
    Context context;
    ElevationReader reader(source, context);
    (void)reader.survey({land_elevations, {1e9, 1e9}, 1, {}}, [](const ElevationBand&) {});
    {
        pipeline::UnitSurface surface(reader, seen, metres, *context.threads);
        EXPECT_EQ(surface.elevations().rows, seen.rows);
        Grid<std::uint8_t> flags(seen.rows, seen.cols, 1);
        flags.values[7] |= flag;
        flags.values[400] |= flag;
        surface.mask_flagged(flags, flag, *context.threads);
        for (std::size_t i = 0; i < surface.elevations().size(); ++i)
            if (i == 7 || i == 400)
                EXPECT_TRUE(std::isnan(surface.elevations().values[i]));
            else
                EXPECT_EQ(surface.elevations().values[i], static_cast<float>(z[i] * metres)) << i;
    }
    std::vector<double> after;
    reader.for_each([&](const ElevationBand& band) {
        after.insert(after.end(), band.elevations.begin(), band.elevations.end());
    });
    EXPECT_EQ(after, z);
    return after;
}

TEST(UnitSurface, LeavesTheReadersElevationsAsTheyWere) {
    EXPECT_EQ(after_taking_out(0.25, {0, 0, 20, 30}, 1)[7], 101.75);  // the reader's own
    EXPECT_EQ(after_taking_out(0.25, {0, 0, 19, 30}, 1)[7], 101.75);  // a part
    EXPECT_EQ(after_taking_out(0.25, {0, 0, 20, 30}, 0.3048)[7], 101.75);
    EXPECT_EQ(after_taking_out(0.1, {0, 0, 20, 30}, 1).size(), 600U);  // doubles
}

}  // namespace
}  // namespace d2b::test
