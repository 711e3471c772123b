#include "raster/rank_filter.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "support/random_surface.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

/// Cell by cell and element by element.
float extremum_of_window(const MetreGrid& grid, std::int32_t row, std::int32_t col, Line line, Extremum which,
                         std::int32_t radius) {
    const bool lowest = which == Extremum::lowest;
    float found = lowest ? no_value : -no_value;
    for (std::int32_t k = -radius; k <= radius; ++k) {
        const std::int32_t down = line == Line::row ? 0 : k;
        const std::int32_t across = line == Line::column ? 0 : (line == Line::left_diagonal ? -k : k);
        if (!grid.holds(row + down, col + across))
            continue;
        const float z = grid.at(row + down, col + across);
        found = lowest ? std::min(found, z) : std::max(found, z);
    }
    return found;
}

/// Whole numbers in the order of the elevations.
std::int16_t step_of(float z) {
    constexpr std::int16_t none = no_value_of<std::int16_t>;
    if (std::abs(z) == no_value)
        return z > 0 ? none : static_cast<std::int16_t>(-none);
    return static_cast<std::int16_t>(100 * z - 3000);
}

void expect_every_window(const MetreGrid& grid, Line line, Extremum which, std::int32_t radius) {
    MetreGrid found(grid.rows, grid.cols);
    rank_filter(grid, found, line, which, radius);
    Grid<std::int16_t> steps(grid.rows, grid.cols), found_steps = steps;
    std::ranges::transform(grid.values, steps.values.begin(), step_of);
    rank_filter(steps, found_steps, line, which, radius);
    for (std::int32_t i = 0; i < grid.rows; ++i)
        for (std::int32_t j = 0; j < grid.cols; ++j) {
            const float expected = extremum_of_window(grid, i, j, line, which, radius);
            ASSERT_EQ(found.at(i, j), expected) << "row " << i << " column " << j << " radius " << radius;
            ASSERT_EQ(found_steps.at(i, j), step_of(expected))
                << "row " << i << " column " << j << " radius " << radius;
        }
}

class LinePass : public testing::TestWithParam<std::tuple<Line, Extremum>> {};

TEST_P(LinePass, FindsWhatEveryWindowHolds) {
    const auto [line, which] = GetParam();
    for (unsigned seed = 0; seed < 40; ++seed) {
        const auto rows = static_cast<std::int32_t>(1 + seed * 7 % 23);
        const auto cols = static_cast<std::int32_t>(1 + seed * 5 % 19);
        expect_every_window(test::random_surface(seed, rows, cols), line, which,
                            static_cast<std::int32_t>(seed % 9));
    }
}

TEST_P(LinePass, FindsItAcrossTheStripsOfAWideGrid) {
    const auto [line, which] = GetParam();
    expect_every_window(test::random_surface(3, 9, 4200), line, which, 5);
}

TEST_P(LinePass, WindowsMayBeWiderThanTheGrid) {
    const auto [line, which] = GetParam();
    expect_every_window(test::random_surface(4, 3, 4), line, which, 30);
}

INSTANTIATE_TEST_SUITE_P(AllLines, LinePass,
                         testing::Combine(testing::Values(Line::row, Line::column, Line::right_diagonal,
                                                          Line::left_diagonal),
                                          testing::Values(Extremum::lowest, Extremum::highest)));

TEST(LowestAround, IsTheLowestOfNineCells) {
    MetreGrid grid(4, 4, 7.0F);
    grid.at(1, 1) = 2;
    const MetreGrid around = minimum_3x3(grid, test::threads());
    EXPECT_EQ(around.at(0, 0), 2);
    EXPECT_EQ(around.at(2, 2), 2);
    EXPECT_EQ(around.at(3, 3), 7);
    EXPECT_EQ(around.at(0, 3), 7);
}

}  // namespace
}  // namespace d2b
