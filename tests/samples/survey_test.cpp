// How scenes are seen: figures that follow from the numbers of a survey alone.
#include "survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "blur.hpp"
#include "draft.hpp"
#include "fill_gaps.hpp"
#include "pulses.hpp"
#include "random.hpp"
#include "scan.hpp"

namespace d2b::test {
namespace {

using namespace sample;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Cells over a square from the origin.
Grid cells_over(double side, double cell) {
    const auto count = static_cast<std::int32_t>(side / cell);
    return {count, count, cell, cell, {0, cell, 0, side, 0, -cell}};
}

std::vector<double> scanned(const Scene& scene, const Grid& grid, const Survey& survey) {
    std::vector<double> metres(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.cols));
    scan(scene, grid, survey, 0, grid.rows, metres);
    return metres;
}

double share_of_nan(const std::vector<double>& values) {
    const auto missing = std::count_if(values.begin(), values.end(), [](double z) { return std::isnan(z); });
    return static_cast<double>(missing) / static_cast<double>(values.size());
}

TEST(Pulses, AreAsManyAsTheirDensitySays) {
    const Grid grid = cells_over(100, 0.5);
    // One in each square of a lattice: chance decides at the border of the square of 100 m alone.
    const auto even = pulses_over(grid, {.name = "", .cell = 0.5, .pulses = 8}, 3, 0, grid.rows);
    EXPECT_NEAR(static_cast<double>(even.pulses.size()), 80000, 200);
    // 100,000 of which 6 % are drawn: a standard deviation of 75.
    const auto thin =
        pulses_over(grid, {.name = "", .cell = 0.5, .pulses = 10, .kept = 0.06}, 3, 0, grid.rows);
    EXPECT_NEAR(static_cast<double>(thin.pulses.size()), 6000, 300);
}

TEST(Pulses, AreInTheirCellsAndTheSameInAnyPortions) {
    const Grid grid = cells_over(30, 1);
    const Survey survey{.name = "", .cell = 1, .pulses = 3};
    const PulseRows all = pulses_over(grid, survey, 5, 0, grid.rows);
    std::size_t seen = 0;
    for (const std::int32_t first : {0, 7, 8}) {
        const std::int32_t rows = first == 0 ? 7 : first == 7 ? 1 : 22;
        const PulseRows part = pulses_over(grid, survey, 5, first, rows);
        ASSERT_EQ(all.first[static_cast<std::size_t>(first) * 30], seen);
        for (std::size_t cell = 0; cell + 1 < part.first.size(); ++cell)
            for (std::size_t k = part.first[cell]; k < part.first[cell + 1]; ++k) {
                EXPECT_EQ(part.pulses[k].draw, all.pulses[seen + k].draw);
                EXPECT_EQ(std::floor(part.pulses[k].at.x), static_cast<double>(cell % 30));
                EXPECT_EQ(std::floor(30 - part.pulses[k].at.y),
                          static_cast<double>(first) + static_cast<double>(cell / 30));
            }
        seen += part.pulses.size();
    }
    EXPECT_EQ(seen, all.pulses.size());
}

TEST(Scan, LeavesAsManyCellsWithoutAReturnAsChanceDoes) {
    // 2.5 m hold 62.5 squares of the lattice, of which each sends a pulse with a chance of 3 %; squares
    // across the border of a cell bring the share between (1 - 0.03)^62.5 = 0.149 and exp(-1.875) = 0.153.
    const Survey survey{.name = "", .cell = 2.5, .pulses = 10, .kept = 0.03};
    std::vector<double> seen = scanned({}, cells_over(400, 2.5), survey);
    EXPECT_NEAR(share_of_nan(seen), 0.151, 0.002 + 4 * std::sqrt(0.151 * 0.849 / 25600));
    const double missing = share_of_nan(seen) * 25600;
    // All eight around it lack one too: 0.15^8, in 3,800 cells 0.001.
    EXPECT_EQ(static_cast<double>(fill_gaps(seen, 160, 1.5)), std::round(missing));
    EXPECT_EQ(share_of_nan(seen), 0);
}

/// Area of the cells that a house of 12 x 8 m, 6 m high, raises, in m2.
double raised_area(double beam) {
    Scene scene;
    scene.add(box_house("house", {0, 0, 12, 8}, {Roof::flat, 6, 0}), {{5, 7}, {}});
    const Survey survey{.name = "", .cell = 0.1, .pulses = 400, .beam = beam, .range_noise = 0};
    double raised = 0;
    double returns = 0;
    const std::vector<double> seen = scanned(scene, cells_over(24, 0.1), survey);
    for (const double z : seen) {
        returns += std::isnan(z) ? 0 : 1;
        raised += z == 6 ? 1 : 0;
    }
    return raised / returns * 24 * 24;
}

TEST(Scan, RoofsReachOverTheirWallsByTheBeam) {
    // The walls lie on the borders of cells, which hold four pulses.
    EXPECT_NEAR(raised_area(0), 12 * 8, 0.5);
    EXPECT_NEAR(raised_area(0.2), 12 * 8 + 2 * (12 + 8) * 0.2, 0.5);
}

TEST(Scan, CrownsSendPulsesBackFromBelowTheirHull) {
    const Tree tree{{0, 0}, 100, 10, 4, false, 11};
    Random random(1);
    int hits = 0;
    int pulses = 0;
    double lowest = 200;
    for (int k = 0; k < 40000; ++k) {
        const Position p{random.between(-4, 4), random.between(-4, 4)};
        const auto z = tree.first_return(p, random.next());
        if (distance({0, 0}, p) >= 4) {
            EXPECT_FALSE(z);
            continue;
        }
        ++pulses;
        hits += z ? 1 : 0;
        if (z) {
            EXPECT_LE(*z, 110);
            lowest = std::min(lowest, *z);
        }
    }
    // The chance of a gap is 3 % and 30 % of the distance from the trunk, by half on the mean: 2/3 of the
    // radius.
    EXPECT_NEAR(1 - static_cast<double>(hits) / pulses, 0.03 + 0.3 * 2 / 3 * 0.5, 0.03);
    // Half the height at the rim, 28 % of boughs and 2.5 m of depth below it.
    EXPECT_GE(lowest, 100 + 5 * 0.72 - 2.5);
    EXPECT_LT(lowest, 105);
}

TEST(FillGaps, TakesTheNearestWithinReach) {
    std::vector<double> z{1,   nan, nan, nan,  //
                          nan, nan, nan, nan,  //
                          nan, nan, nan, 7};
    EXPECT_EQ(fill_gaps(z, 4, 1.5), 6);
    const std::vector<double> expected{1, 1, nan, nan, 1, 1, 7, 7, nan, nan, 7, 7};
    for (std::size_t i = 0; i < z.size(); ++i)
        EXPECT_TRUE(z[i] == expected[i] || (std::isnan(z[i]) && std::isnan(expected[i]))) << i;
    EXPECT_EQ(fill_gaps(z, 4, 1), 4);
    EXPECT_EQ(fill_gaps(z, 4, 1), 0);
}

TEST(FillGaps, TakesTheMeanByInverseSquares) {
    std::vector<double> z{1, nan, nan, 7};
    EXPECT_EQ(fill_gaps(z, 4, 2, GapFilling::weighted), 2);
    EXPECT_DOUBLE_EQ(z[1], (1.0 / 1 + 7.0 / 4) / (1.0 / 1 + 1.0 / 4));
    EXPECT_DOUBLE_EQ(z[2], (1.0 / 4 + 7.0 / 1) / (1.0 / 4 + 1.0 / 1));
    std::vector<double> far{1, nan, nan, nan, nan, 7};
    EXPECT_EQ(fill_gaps(far, 6, 1, GapFilling::weighted), 2);
    EXPECT_TRUE(std::isnan(far[2]));
}

TEST(Blur, MakesAStepAsWideAsAGaussianDoes) {
    constexpr int cols = 101;
    constexpr double deviation = 8;
    std::vector<double> z(std::size_t{cols} * 3);
    for (std::size_t i = 0; i < z.size(); ++i)
        z[i] = i % cols >= 50 ? 1 : 0;
    blur(z, cols, deviation);
    for (int col = 20; col <= 80; ++col) {
        // The wall is between the cells 49 and 50.
        const double normal = 0.5 * (1 + std::erf((col - 49.5) / deviation / std::sqrt(2.0)));
        EXPECT_NEAR(z[cols + static_cast<std::size_t>(col)], normal, 0.001) << col;
    }
}

TEST(Blur, KeepsWhatIsLevel) {
    std::vector<double> z(400, 12.5);
    blur(z, 20, 3);
    for (const double value : z)
        EXPECT_NEAR(value, 12.5, 1e-12);
}

TEST(See, RoundsElevationsOrHeightsAlone) {
    Scene scene;
    scene.ground.base = 10.25;
    scene.add(box_house("house", {0, 0, 12, 8}, {Roof::gabled, 5, 0.7}), {{5, 7}, {}});
    const Grid grid = cells_over(30, 1);
    for (const bool heights : {false, true}) {
        const Survey survey{.name = "", .cell = 1, .pulses = 4, .step = 1, .heights_alone = heights};
        std::size_t roof = 0;
        for (const float z : see(scene, grid, survey).elevations) {
            const double from = static_cast<double>(z) - (heights ? 10.25 : 0);
            EXPECT_EQ(from, std::round(from));
            roof += z > 14 ? 1U : 0U;
        }
        EXPECT_NEAR(static_cast<double>(roof), 96, 44);  // a ring of cells around it is 44
    }
}

}  // namespace
}  // namespace d2b::test
