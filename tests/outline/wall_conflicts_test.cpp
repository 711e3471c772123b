#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "outline/outline.hpp"
#include "support/outline_checks.hpp"
#include "support/trace_grid.hpp"

namespace d2b::outline {
namespace {

using test::trace_grid;
using test::TraceGrid;
using test::unit_grid;

constexpr std::int32_t side = 120;       // cells
constexpr Position middle{60.3, -59.6};  // of the house; y is up
constexpr double half_length = 50;
constexpr double half_width = 20;
constexpr double along = 0.6;      // radians, the direction of its long walls
constexpr double jumble_from = 0;  // along the house, from its middle: the jumbled part lies beyond that
const std::vector<double> levels{10, 40, 50, 60, 70, 80, 90, 100};

/// Along the house and across it, from its middle.
Position in_house(Position p) {
    const double x = p.x - middle.x;
    const double y = p.y - middle.y;
    return {x * std::cos(along) + y * std::sin(along), y * std::cos(along) - x * std::sin(along)};
}

/// A house of 100 x 40 cells with a flat roof over one half. In the other half, towers and pits of
/// all shapes stand side by side, up to the walls.
TraceGrid jumbled_house(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<double> coarse(std::size_t{side} * side);
    for (double& z : coarse)
        z = static_cast<double>(random() % 100);
    TraceGrid grid{side, side, {}, {}};
    for (std::int32_t row = 0; row < side; ++row)
        for (std::int32_t col = 0; col < side; ++col) {
            const Position p = in_house({col + 0.5, -(row + 0.5)});
            const bool inside = std::abs(p.x) < half_length && std::abs(p.y) < half_width;
            const double jumble = coarse[static_cast<std::size_t>(row / 3 * side + col / 3)] +
                                  static_cast<double>(random() % 100);
            grid.z.push_back(!inside ? 0 : (p.x > jumble_from ? 30 + jumble : 20));
        }
    return grid;
}

/// Walls in conflict become staircases at the place of the conflict, and neither those of the whole house nor
/// those of the parts around.
class WallConflicts : public testing::TestWithParam<unsigned> {};

TEST_P(WallConflicts, leaveTheWallsElsewhere) {
    Context context;
    const test::ContourSet set = trace_grid(jumbled_house(GetParam()), levels, {}, context);
    OutlineRules rules;
    rules.walls = Walls::automatic;
    rules.wall_tolerance = 1.5;
    const Outliner outliner(*set.list, OutlineMethod::regularized, rules, unit_grid, 1, context);
    ASSERT_EQ(set.buildings.size(), 1U);
    // The corners at the other end are where the house has its corners; two others at most, which long walls
    // may have without any conflict.
    std::vector<Position> corners;
    const FineRing ring = outliner.outline(static_cast<std::size_t>(set.buildings.front())).exterior;
    for (const FinePoint corner : ring)
        if (const Position p = in_house(unit_grid.position(corner)); p.x < jumble_from - 20)
            corners.push_back(p);
    EXPECT_LE(corners.size(), 4U);
    for (const double y : {-half_width, half_width})
        EXPECT_TRUE(std::ranges::any_of(
            corners, [&](const Position& p) { return std::hypot(p.x + half_length, p.y - y) < 1; }));
}

INSTANTIATE_TEST_SUITE_P(Seeds, WallConflicts, testing::Range(0U, 60U));
/// Conflicts between walls that follow their trace there already.
INSTANTIATE_TEST_SUITE_P(StubbornSeeds, WallConflicts,
                         testing::Values(150U, 393U, 574U, 602U, 647U, 725U, 784U, 1768U));

}  // namespace
}  // namespace d2b::outline
