#include "detect/surface_sampling.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "support/test_threads.hpp"

namespace d2b::test {
namespace {

constexpr std::int32_t side = 100;  // cells
constexpr Window all{0, 0, side, side};

/// A surface on level ground, and the objects found on it.
struct Found {
    MetreGrid surface{side, side};
    MetreGrid terrain{side, side};
    detect::Detection detection;

    Found() {
        detection.labels = Grid<Label>(side, side);
        detection.buildings = 1;
    }
    [[nodiscard]] detect::SurfaceSampling counted(const Window& own = all) const {
        detect::SurfaceSampling sampling;
        const detect::Scene scene{surface, terrain, {}};
        detect::add_sampling(scene, detection, 2, own, sampling, threads());
        return sampling;
    }
    [[nodiscard]] SamplingReport report() const { return detect::sampling_report(counted(), 1); }
};

/// A wall at 0, blurred by a normal distribution.
double blurred(double place, double blur) {
    return std::erfc(-place / blur / std::numbers::sqrt2) / 2;
}

/// A block of 40 x 30 cells, 8 m high, on a plain.
Found blurred_block(double blur) {
    Found found;
    const auto within = [blur](std::int32_t i, double begin, double end) {
        return blurred(i + 0.5 - begin, blur) - blurred(i + 0.5 - end, blur);
    };
    for (std::int32_t r = 0; r < side; ++r)
        for (std::int32_t c = 0; c < side; ++c) {
            found.surface.at(r, c) = static_cast<float>(8 * within(r, 30, 70) * within(c, 40, 70));
            found.detection.labels.at(r, c) = found.surface.at(r, c) > 4 ? 1 : 0;
        }
    return found;
}

/// Crowns 5 to 15 m high, seen by points that chance drops, so many a cell on the mean: one without any takes
/// the height of a neighbour.
Found crowns(double points) {
    std::mt19937 random(7);  // NOLINT: the same crowns in every run
    std::uniform_real_distribution<float> height(5, 15);
    std::poisson_distribution<int> fallen(points);
    Found found;
    MetreGrid seen(side, side);
    for (float& z : seen.values)
        z = fallen(random) > 0 ? height(random) : 0;
    found.surface = seen;
    for (std::int32_t r = 0; r < side; ++r)
        for (std::int32_t c = 0; c < side; ++c)
            for (const auto& [down, right] : {std::pair{0, -1}, {-1, 0}, {0, 1}, {1, 0}})
                if (found.surface.at(r, c) == 0 && seen.holds(r + down, c + right))
                    found.surface.at(r, c) = seen.at(r + down, c + right);
    return found;
}

TEST(SurfaceSampling, WallsAreAsWideAsTheyWereBlurred) {
    for (const double blur : {1.0, 1.5, 2.0, 2.5}) {
        const double width = blurred_block(blur).report().edge_width_cells.value();
        EXPECT_NEAR(width, 2.563 * blur, 0.15 * 2.563 * blur) << blur;
    }
    EXPECT_LT(blurred_block(0.01).report().edge_width_cells.value(), 0.1) << "a wall between two cells";
}

TEST(SurfaceSampling, StepsAreThoseOfBuildingsThatStandFree) {
    const Found block = blurred_block(0.01);
    EXPECT_EQ(block.counted().steps, 2 * (40 + 30));
    Found doubtful = block;
    doubtful.detection.buildings = 0;
    EXPECT_EQ(doubtful.counted().steps, 0);
    EXPECT_EQ(doubtful.report().edge_width_cells, std::nullopt);
    Found beside = block;
    for (std::int32_t r = 0; r < side; ++r)
        beside.detection.labels.at(r, 72) = 2;
    EXPECT_EQ(beside.counted().steps, 2 * 30 + 40) << "something stands three cells beside one wall";
    Found low = block;
    for (float& z : low.surface.values)
        z /= 4;
    EXPECT_EQ(low.counted().steps, 0) << "2 m are not more than the least height";
    Found gap = block;
    for (std::int32_t r = 0; r < side; ++r)
        gap.surface.at(r, 71) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(gap.counted().steps, 2 * 30 + 40);
}

TEST(SurfaceSampling, PointsAreAsManyAsFellIntoACell) {
    for (const double points : {1.3, 1.6, 2.0, 2.5, 3.0}) {
        const SamplingReport report = crowns(points).report();
        EXPECT_NEAR(report.points_per_cell.value(), points, 0.25 * points);
        EXPECT_EQ(report.points_per_cell.value(), -std::log(report.interpolated_fraction));
    }
    EXPECT_EQ(crowns(8).report().points_per_cell, std::nullopt) << "of so many cells three are empty";
    EXPECT_EQ(Found().report().points_per_cell, std::nullopt) << "nothing is rough";
}

TEST(SurfaceSampling, OfAModelsCornersNothingFollows) {
    Found found = crowns(1.5);
    found.detection.labels = Grid<Label>(side, side, 1);
    EXPECT_NE(found.report().points_per_cell, std::nullopt);
    // An eighth of it stays, which is enough to count; the rest are flat roofs.
    for (std::int32_t r = 12; r < side; ++r)
        for (std::int32_t c = 0; c < side; ++c)
            found.surface.at(r, c) = 9;
    ASSERT_GE(found.counted().rough.all, 300);
    ASSERT_GT(detect::interpolated_fraction(found.counted().rough), 0.1);
    for (const std::int64_t built : {10, 11}) {
        detect::SurfaceSampling sampling = found.counted();
        sampling.built = built * sampling.rough.all;
        EXPECT_EQ(detect::sampling_report(sampling, 1).points_per_cell.has_value(), built == 10);
    }
}

/// Units and threads do not change the report, because parts add up to it.
TEST(SurfaceSampling, PartsAddUpToTheWhole) {
    Found found = crowns(1.5);
    const Found block = blurred_block(1);
    for (std::size_t i = 0; i < block.surface.size(); ++i)
        if (block.surface.values[i] > 0.1F)
            found.surface.values[i] = block.surface.values[i];
    found.detection = block.detection;
    const detect::SurfaceSampling whole = found.counted();
    detect::SurfaceSampling sum;
    for (const Window& own :
         {Window{0, 0, 33, 41}, Window{0, 41, 33, 59}, Window{33, 0, 67, 41}, Window{33, 41, 67, 59}})
        sum.merge(found.counted(own));
    EXPECT_GT(whole.steps, 0);
    EXPECT_GT(whole.rough.counts[0], 0);
    EXPECT_EQ(sum.rough.counts, whole.rough.counts);
    EXPECT_EQ(sum.rough.all, whole.rough.all);
    EXPECT_EQ(whole.built, 40 * 30 - 4) << "the blur takes the corners";
    EXPECT_EQ(sum.built, whole.built);
    EXPECT_EQ(sum.steps, whole.steps);
    EXPECT_EQ(sum.falls, whole.falls);
    EXPECT_EQ(sum.steepest, whole.steepest);
}

}  // namespace
}  // namespace d2b::test
