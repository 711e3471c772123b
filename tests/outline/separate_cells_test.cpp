#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "outline/walls/wall_segmentation.hpp"

namespace d2b::outline {
namespace {

/// The ground has y to the north: a wall's left is that of the lattice.
const CellShape north_up{{1, 0}, {0, -1}};
const CellShape south_up{{1, 0}, {0, 1}};

/// The border of the cells whose middles lie below a line of a slope from 0 to 1, from west to east: rows
/// count downwards.
std::vector<LatticePoint> digitised(double at, double slope, std::int32_t n) {
    std::vector<LatticePoint> trace;
    const auto row = [&](std::int32_t col) {
        return static_cast<std::int32_t>(std::ceil(-(at + slope * (col + 0.5)) - 0.5));
    };
    trace.push_back({row(0), 0});
    for (std::int32_t col = 1; col < n; ++col)
        if (row(col) != row(col - 1)) {
            trace.push_back({row(col - 1), col});
            trace.push_back({row(col), col});
        }
    trace.push_back({row(n - 1), n});
    return trace;
}

std::vector<WallSegment> nearest_line(const TraceSums& samples) {
    const TraceSums::Sums sums = samples.sums(0, samples.steps());
    return {{0, samples.steps(), 0, {sums.mean, sums.direction()}, {}}};
}

int wrong_cells(const TraceSums& samples, const Line2& wall) {
    int wrong = 0;
    for (std::size_t step = 0; step < samples.steps(); ++step) {
        const TraceSums::Cells cells = samples.adjacent_cells(step);
        wrong += wall.offset(cells.left) > 0 ? 0 : 1;
        wrong += wall.offset(cells.right) < 0 ? 0 : 1;
    }
    return wrong;
}

TEST(SeparateCells, WhatALineHasDigitisedToItLiesOnItsOwnSide) {
    int before = 0;
    int after = 0;
    for (int i = 1; i <= 50; ++i)
        for (int k = 0; k < 10; ++k) {
            const double slope = i / 50.0;
            const TraceSums samples(digitised(0.1 * k, slope, 23), false, north_up);
            const Vec2 along = 1 / std::sqrt(1 + slope * slope) * Vec2{1, slope};
            const Vec2 first = samples.at(0);
            // Seen from the first corner; 0.2 too high or too low.
            const double row = -std::ceil(-(0.1 * k + slope * 0.5) - 0.5);
            std::vector<WallSegment> wall{
                {0,
                 samples.steps(),
                 0,
                 {first + Vec2{0, 0.1 * k - row + (k % 2 == 0 ? 0.2 : -0.2)}, along},
                 {}}};
            before += wrong_cells(samples, wall[0].line);
            separate_cells(samples, 0, 2, wall);
            after += wrong_cells(samples, wall[0].line);
        }
    EXPECT_GT(before, 1000);
    EXPECT_LT(after, before / 50);  // where two middles leave less room than a wall needs
}

TEST(SeparateCells, AWallOnWhichNoneIsWrongStays) {
    const TraceSums samples({{0, 0}, {0, 12}}, false, north_up);
    std::vector<WallSegment> wall = nearest_line(samples);
    separate_cells(samples, 1, 1, wall);
    EXPECT_EQ(wall[0].line.through, (Vec2{6, 0}));
}

/// Six cells of the lower row are wrong beside a wall above them, as many of the upper row beside one below.
class Step : public testing::Test {
  protected:
    [[nodiscard]] static double moved(int higher, const CellShape& shape, double limit = 1.5) {
        const TraceSums samples({{0, 0}, {0, 6}, {-1, 6}, {-1, 12}}, false, shape);
        // Halfway between both halves, where it passes the middles of all.
        const Vec2 left = samples.left_of({1, 0});
        std::vector<WallSegment> wall{{0, samples.steps(), 0, {{0, 0.5 * left.y}, {1, 0}}, {}}};
        separate_cells(samples, higher, limit, wall);
        return dot(left, wall[0].line.through) - 0.5;
    }
};

TEST_F(Step, WhatIsHigherGivesAwayRatherThanItTakes) {
    EXPECT_DOUBLE_EQ(moved(1, north_up), 1.0 / 256);
    EXPECT_DOUBLE_EQ(moved(-1, north_up), -1.0 / 256);
}

TEST_F(Step, RowsThatRunNorthChangeNothing) {
    EXPECT_DOUBLE_EQ(moved(1, south_up), 1.0 / 256);
    EXPECT_DOUBLE_EQ(moved(-1, south_up), -1.0 / 256);
}

TEST_F(Step, AWallStaysWithinTheLimit) {
    EXPECT_EQ(moved(1, north_up, 0.502), 0);
}

TEST(ShiftWall, GoesToTheLeftOfTheWay) {
    for (const CellShape& shape : {north_up, south_up}) {
        // Row -1 lies on the left of a way along a row.
        const TraceSums samples({{0, 0}, {0, 4}}, false, shape);
        WallSegment wall{0, 4, 0, {{2, 0}, {-1, 0}}, {}};
        shift_wall(wall, samples, 0.25);
        EXPECT_EQ(wall.line.through, shape.from_cells(-0.25, 2));
    }
}

class MoveInward : public testing::Test {
  protected:
    TraceSums samples_{{{0, 0}, {0, 4}}, false, north_up};
    /// Place of a wall along a row after a move by 0.5: rows to the north.
    [[nodiscard]] double moved(int higher, double limit) const {
        std::vector<WallSegment> walls{{0, 4, 0, {{2, 0}, {-1, 0}}, {}}};
        move_inward(samples_, higher, 0.5, limit, walls);
        return walls[0].line.through.y;
    }
};

TEST_F(MoveInward, GoesTowardsWhatIsHigher) {
    EXPECT_DOUBLE_EQ(moved(1, 1), 0.5);
    EXPECT_DOUBLE_EQ(moved(-1, 1), -0.5);
    EXPECT_DOUBLE_EQ(moved(0, 1), 0);
}

TEST_F(MoveInward, GoesAsFarAsTheLimitLetsIt) {
    EXPECT_DOUBLE_EQ(moved(1, 0.4), 0.375);
    EXPECT_DOUBLE_EQ(moved(1, 0.2), 0.125);
    EXPECT_DOUBLE_EQ(moved(1, 0.1), 0);
}

}  // namespace
}  // namespace d2b::outline
