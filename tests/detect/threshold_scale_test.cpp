#include "detect/threshold_scale.hpp"

#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "detect_case.hpp"
#include "raster/morphology.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

/// Square houses at distances of 50 m, whose flat roofs are rough: each cell lies up to so much higher or
/// lower.
Town town_with(float rough, std::int32_t houses, std::int32_t side = 28) {
    Town town(20 + 50 * houses, 20 + 50 * houses);
    std::mt19937 random(31);  // NOLINT: the same roofs in every run
    std::uniform_real_distribution<float> relief(-rough, rough);
    town.build([&](std::int32_t r, std::int32_t c) {
        return r >= 20 && c >= 20 && (r - 20) % 50 < side && (c - 20) % 50 < side ? 110 + relief(random)
                                                                                  : unknown;
    });
    return town;
}

double strictness_of(const Town& town) {
    SceneCells cells = scene_cells(town.scene(), {}, threads());
    flag_cells(town.scene(), {}, cells, threads());
    return estimate_threshold_scale(town.scene(), cells, {}, default_min_building_m2, {}, threads());
}

TEST(ThresholdScale, AsStrictAsTheRoofsAllow) {
    EXPECT_EQ(strictness_of(town_with(0, 3)), 0.35);
    double before = 0.35;
    for (const float rough : {0.1F, 0.2F, 0.25F, 0.3F, 0.35F}) {
        const double found = strictness_of(town_with(rough, 3));
        EXPECT_GE(found, before) << rough;
        before = found;
    }
    EXPECT_GE(before, 0.9) << "hardly smoother than the usual limits allow";
}

TEST(ThresholdScale, ARoofCostsMoreThanItsCells) {
    // The limits that lose one roof of nine take away a ninth of the objects, and a ninth of the roofs.
    Town town = town_with(0, 3);
    const Town rough = town_with(0.3F, 3);
    for (std::int32_t r = 20; r < 48; ++r)
        std::copy_n(rough.surface.row(r).begin() + 20, 28, town.surface.row(r).begin() + 20);
    const double all_rough = strictness_of(rough);
    EXPECT_GT(all_rough, 0.35);
    EXPECT_EQ(strictness_of(town), all_rough);
}

TEST(ThresholdScale, NothingWhereRoofsAreFew) {
    EXPECT_EQ(strictness_of(town_with(0, 1, 25)), 0.35) << "23 x 23 = 529 cells are 1 m inside the house";
    EXPECT_EQ(strictness_of(town_with(0, 1, 24)), 1) << "22 x 22 = 484";
    Town none(50, 50);
    EXPECT_EQ(strictness_of(none), 1);
    EXPECT_EQ(strictness_of(Town(0, 0)), 1);
}

TEST(ThresholdScale, CoarseCellsBoundIt) {
    Town town = town_with(0, 3);
    town.cell = {2, 2};
    EXPECT_EQ(strictness_of(town), 0.9);
}

/// Gables of a slope of 0.5, whose cells have the height of the highest of so many points in them.
Town gables_of(int points) {
    std::mt19937 random(32);  // NOLINT: the same roofs in every run
    std::uniform_real_distribution<float> within(0, 1);
    Town town(170, 170);
    town.build([&](std::int32_t r, std::int32_t c) {
        if (r < 20 || c < 20 || (r - 20) % 50 >= 28 || (c - 20) % 50 >= 28)
            return unknown;
        const auto across = static_cast<float>((c - 20) % 50);
        float highest = 0;
        for (int i = 0; i < points; ++i) {
            const float at = across + within(random);
            highest = std::max(highest, 105 + 0.5F * std::min(at, 28 - at));
        }
        return highest;
    });
    return town;
}

TEST(ThresholdScale, NothingWhereSlopesAreThinlySampled) {
    EXPECT_EQ(strictness_of(gables_of(1)), 1);
    EXPECT_EQ(strictness_of(gables_of(2)), 1);
    EXPECT_LT(strictness_of(gables_of(8)), 1);
}

TEST(ThresholdScale, NothingWhereWallsAreSmeared) {
    Town town = town_with(0, 3);
    const MetreGrid sharp = town.surface;
    for (std::int32_t r = 2; r < sharp.rows - 2; ++r)
        for (std::int32_t c = 2; c < sharp.cols - 2; ++c) {
            float sum = 0;
            for (std::int32_t y = r - 2; y <= r + 2; ++y)
                for (std::int32_t x = c - 2; x <= c + 2; ++x)
                    sum += sharp.at(y, x);
            town.surface.at(r, c) = sum / 25;
        }
    EXPECT_EQ(strictness_of(town), 1);
}

TEST(ThresholdScale, IsFoundFromTheSceneItself) {
    // Rough roofs are found by limits of their own, and not by those of another place.
    const Town rough = town_with(0.35F, 3);
    EXPECT_EQ(detect_in(rough).buildings, 9U);
    SurfaceQuality other;
    other.threshold_scale = 0.1;
    SceneCells cells = scene_cells(rough.scene(), {}, threads());
    const Candidates judged =
        find_candidates(rough.scene(), cells, default_min_building_m2, other, threads());
    EXPECT_TRUE(std::ranges::none_of(judged.objects, [](const DetectedObject& object) {
        return object.confidence >= DetectOptions{}.min_confidence;
    }));
}

TEST(SceneSamples, AreTheSquaresWithMostCellsOfTheMask) {
    const MetreGrid surface = [] {
        MetreGrid z(2100, 3000);
        std::iota(z.values.begin(), z.values.end(), 0.0F);
        return z;
    }();
    const MetreGrid terrain(2100, 3000, 1.0F);
    Mask mask(2100, 3000);
    const auto fill = [&](std::int32_t row, std::int32_t col, std::int32_t cells) {
        for (std::int32_t c = col; c < col + cells; ++c)
            mask.at(row, c) = 1;
    };
    fill(5, 1500, 30);     // the first row of squares, the second of its three
    fill(1030, 0, 50);     // the second, the first
    fill(2099, 2990, 10);  // the last
    const std::vector<SceneSample> samples = scene_samples({surface, terrain, {2, 3}}, mask, threads());
    ASSERT_EQ(samples.size(), 3U);
    EXPECT_EQ(samples[0].surface.at(0, 0), surface.at(1024, 0));
    EXPECT_EQ(samples[1].surface.at(0, 0), surface.at(0, 1024));
    EXPECT_EQ(samples[2].surface.rows, 2100 - 2048);
    EXPECT_EQ(samples[2].surface.cols, 3000 - 2048);
    EXPECT_EQ(samples[0].scene().cell.down, 3);
    EXPECT_EQ(samples[0].scene().allowed, nullptr);
    fill(3, 0, 5);
    fill(3, 2500, 5);
    const std::vector<SceneSample> cut =
        scene_samples({surface, terrain, {}, &mask, &surface}, mask, threads());
    ASSERT_EQ(cut.size(), 4U) << "four at most";
    EXPECT_EQ(cut[3].surface.at(0, 0), surface.at(0, 0)) << "of equal ones the first";
    EXPECT_EQ(cut[1].scene().allowed->at(5, 476), 1);
    EXPECT_EQ(cut[1].scene().allowed->at(5, 475), 0);
    EXPECT_EQ(cut[1].scene().greenness->values, cut[1].surface.values);
    EXPECT_TRUE(scene_samples({surface, terrain, {}}, Mask(2100, 3000), threads()).empty());
}

/// Ground, and from column 10 on a roof 6 m above it, over a ramp of so many cells.
MetreGrid wall(std::int32_t ramp) {
    MetreGrid surface(20, 30, 100.0F);
    for (std::int32_t r = 0; r < 20; ++r)
        for (std::int32_t c = 10 - ramp; c < 30; ++c)
            surface.at(r, c) =
                100 + 6 * std::min(1.0F, static_cast<float>(c - (9 - ramp)) / static_cast<float>(ramp + 1));
    return surface;
}

double sharpness_of(const MetreGrid& surface) {
    Mask roof(20, 30);
    for (std::int32_t r = 0; r < 20; ++r)
        std::fill(roof.row(r).begin() + 10, roof.row(r).end(), std::uint8_t{1});
    return step_falls(surface, roof, threads()).sharpness();
}

TEST(StepSharpness, IsTheShareOfTheFirstCellInThree) {
    EXPECT_EQ(sharpness_of(wall(0)), 1.0);
    EXPECT_NEAR(sharpness_of(wall(1)), 1.0 / 2, 1e-3);
    EXPECT_NEAR(sharpness_of(wall(2)), 1.0 / 3, 1e-3);
    EXPECT_NEAR(sharpness_of(wall(5)), 1.0 / 3, 1e-3) << "farther than three cells it does not look";
}

TEST(StepSharpness, OneWhereNothingFallsOrIsKnown) {
    EXPECT_EQ(sharpness_of(MetreGrid(20, 30, 7.0F)), 1.0);
    EXPECT_EQ(sharpness_of(MetreGrid(20, 30, unknown)), 1.0);
    EXPECT_EQ(step_falls(MetreGrid(), Mask(), threads()).sharpness(), 1.0);
    MetreGrid gaps = wall(0);
    for (std::int32_t r = 0; r < 20; ++r)
        gaps.at(r, 9) = unknown;
    EXPECT_EQ(sharpness_of(gaps), 0.0) << "what is not valid is no fall";
}

}  // namespace
}  // namespace d2b::detect
