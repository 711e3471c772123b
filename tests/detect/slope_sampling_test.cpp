#include "detect/slope_sampling.hpp"

#include <algorithm>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include "detect/sampling_rules.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

constexpr std::int32_t grid_cells = 120;

/// A slope of 0.5 along rows; each cell has the height of the highest of so many points at random positions.
MetreGrid slope_of(int points, double cell, double rise = 0.5) {
    MetreGrid surface(grid_cells, grid_cells);
    std::mt19937 random(7);  // NOLINT: the same points in every run
    std::uniform_real_distribution<double> within(0, 1);
    for (std::int32_t r = 0; r < grid_cells; ++r)
        for (std::int32_t c = 0; c < grid_cells; ++c) {
            double highest = 0;
            for (int i = 0; i < points; ++i)
                highest = std::max(highest, within(random));
            surface.at(r, c) = static_cast<float>(rise * cell * (c + highest));
        }
    return surface;
}

std::optional<SlopeSampling> sampling_of(const MetreGrid& surface, double cell) {
    const MetreGrid terrain(grid_cells, grid_cells, 0.0F);
    return slope_errors({surface, terrain, {cell, cell}}, Mask(grid_cells, grid_cells, 1), threads())
        .sampling();
}

TEST(SlopeSampling, ErrorIsThatOfTheHighestPoint) {
    // The highest of n points has the variance n / ((n + 1)^2 (n + 2)) of a cell along the slope. With six
    // degrees of freedom the most frequent deviation is the root of 5 / 6 of its root.
    for (const double cell : {0.5, 1.0, 2.0}) {
        EXPECT_NEAR(sampling_of(slope_of(1, cell), cell)->error_m, 0.263 * cell, 0.05 * cell) << cell;
        EXPECT_NEAR(sampling_of(slope_of(2, cell), cell)->error_m, 0.215 * cell, 0.05 * cell) << cell;
        EXPECT_NEAR(sampling_of(slope_of(5, cell), cell)->error_m, 0.129 * cell, 0.04 * cell) << cell;
    }
}

TEST(SlopeSampling, DoesNotDependOnTheSlope) {
    EXPECT_NEAR(sampling_of(slope_of(2, 1, 0.4), 1)->error_m, sampling_of(slope_of(2, 1, 0.8), 1)->error_m,
                0.03);
}

TEST(SlopeSampling, MostWindowsOfAPlaneAreNoRougherThanOnePointPerCell) {
    EXPECT_GT(sampling_of(slope_of(1, 1), 1)->planar_share, 0.85);
    EXPECT_GT(sampling_of(slope_of(2, 1), 1)->planar_share, 0.95);
    MetreGrid crowns = slope_of(1, 1);
    std::mt19937 random(8);  // NOLINT
    std::uniform_real_distribution<float> leaves(-1, 1);
    for (float& z : crowns.values)
        z += leaves(random);
    EXPECT_LT(sampling_of(crowns, 1)->planar_share, 0.2);
}

TEST(SlopeSampling, NothingWhereNothingSlopes) {
    EXPECT_FALSE(sampling_of(MetreGrid(grid_cells, grid_cells, 7.0F), 1).has_value());
    EXPECT_FALSE(sampling_of(slope_of(2, 1, 0.1), 1).has_value());
    EXPECT_FALSE(sampling_of(slope_of(1, 1, 3), 1).has_value()) << "too steep for a roof";
}

TEST(SlopeSampling, WindowsLieWithinRoofs) {
    const MetreGrid surface = slope_of(2, 1);
    const MetreGrid terrain(grid_cells, grid_cells, 0.0F);
    Mask roofs(grid_cells, grid_cells);
    const auto fill = [&](std::int32_t rows) {
        for (std::int32_t r = 10; r < 10 + rows; ++r)
            std::fill_n(roofs.row(r).begin() + 10, 52, std::uint8_t{1});
    };
    fill(2);
    EXPECT_FALSE(slope_errors({surface, terrain, {}}, roofs, threads()).sampling().has_value())
        << "too narrow";
    fill(5);
    EXPECT_FALSE(slope_errors({surface, terrain, {}}, roofs, threads()).sampling().has_value())
        << "3 x 50 windows";
    fill(7);
    EXPECT_TRUE(slope_errors({surface, terrain, {}}, roofs, threads()).sampling().has_value())
        << "5 x 50 windows";
}

TEST(SlopeSampling, ThinSlopesArePlanesFarFromTheirPoints) {
    EXPECT_TRUE(has_sparse_slopes(*sampling_of(slope_of(2, 1), 1)));
    EXPECT_FALSE(has_sparse_slopes(*sampling_of(slope_of(5, 1), 1)));
    EXPECT_FALSE(has_sparse_slopes(*sampling_of(slope_of(2, 0.5), 0.5))) << "eight points per square metre";
    EXPECT_FALSE(has_sparse_slopes({0.25, 0.4})) << "clutter, not slopes";
}

}  // namespace
}  // namespace d2b::detect
