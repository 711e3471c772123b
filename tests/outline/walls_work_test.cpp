#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "outline/walls/fit_walls.hpp"
#include "support/outline_checks.hpp"
#include "support/trace_grid.hpp"

namespace d2b::outline {
namespace {

using test::trace_grid;
using test::TraceGrid;

/// Counts how often the fit of walls asks whether to stop: it does so for each edge, arc, ring, wall and
/// turning point that it looks at, so this is its work, whatever else the machine does.
double work_of(const TraceGrid& grid, const std::vector<double>& levels, int noise_factor = 0) {
    Context context;
    const test::ContourSet set = trace_grid(grid, levels, {TraceMode::cells, noise_factor}, context);
    double asked = 0;
    context.threads = std::make_unique<Executor>(1, [&] {
        ++asked;
        return false;
    });
    const RegularizedOutlines outlines(*set.list, {Walls::automatic, 1.5, {}}, context.make_spool(),
                                       *context.threads);
    return asked;
}

/// One ragged building: a plate with noise on it, so that towers and pits of all shapes stand side by side.
TraceGrid ragged(int rows, int cols) {
    TraceGrid grid{rows, cols, {}, {}};
    std::mt19937 random(3);
    std::vector<double> coarse(static_cast<std::size_t>((rows / 3 + 2) * (cols / 3 + 2)));
    for (double& z : coarse)
        z = static_cast<double>(random() % 100);
    for (int row = 0; row < rows; ++row)
        for (int col = 0; col < cols; ++col) {
            const bool outside = row < 2 || col < 2 || row >= rows - 2 || col >= cols - 2;
            const double z = coarse[static_cast<std::size_t>(row / 3 * (cols / 3 + 2) + col / 3)];
            grid.z.push_back(outside ? 0 : 30 + z + static_cast<double>(random() % 20));
        }
    return grid;
}

TEST(WallsWork, IsLinearInTheCellsOfARaggedBuilding) {
    const std::vector<double> levels{10, 60, 90, 120};
    const double small = work_of(ragged(90, 90), levels, 8);
    const double large = work_of(ragged(180, 180), levels, 8);
    EXPECT_GT(small, 10000);
    EXPECT_LT(large, 2.5 * 2.5 * small);
}

/// A wall round which towers stand, each a cell away from the next.
TraceGrid towers(int count) {
    TraceGrid grid{16, 4 * count + 6, {}, {}};
    for (int row = 0; row < grid.rows; ++row)
        for (int col = 0; col < grid.cols; ++col) {
            const bool inside = row >= 2 && row < 14 && col >= 2 && col < grid.cols - 2;
            const bool tower = row >= 2 && row < 5 && col >= 4 && (col - 4) % 4 < 3 && col < grid.cols - 4;
            grid.z.push_back(!inside ? 0 : (tower ? 30 : 10));
        }
    return grid;
}

TEST(WallsWork, IsLinearInTheTowersAlongAWall) {
    EXPECT_LT(work_of(towers(400), {5, 20}), 4.5 * work_of(towers(100), {5, 20}));
}

/// A corridor of eight corners a turn, three cells wide, around its middle.
TraceGrid spiral(int side) {
    TraceGrid grid{side, side, {}, {}};
    const double middle = side / 2.0;
    for (int row = 0; row < side; ++row)
        for (int col = 0; col < side; ++col) {
            const double x = col + 0.5 - middle;
            const double y = row + 0.5 - middle;
            const double radius = std::hypot(x, y);
            const double turn = std::fmod(radius / 10 - std::atan2(y, x) / 6.283185307 + 2, 1.0);
            grid.z.push_back(radius < middle - 4 && turn < 0.5 ? 20 : 0);
        }
    return grid;
}

TEST(WallsWork, IsLinearInTheLengthOfASpiral) {
    EXPECT_LT(work_of(spiral(800), {10}), 5 * work_of(spiral(400), {10}));
}

TEST(WallsWork, EndsSoonAfterItIsAskedTo) {
    Context context;
    const test::ContourSet set = trace_grid(ragged(60, 60), {10, 60, 90}, {}, context);
    for (const int after : {0, 1, 100, 1000, 5000}) {
        int asked = 0;
        context.threads = std::make_unique<Executor>(1, [&] { return ++asked > after; });
        EXPECT_THROW(RegularizedOutlines(*set.list, {Walls::automatic, 1.5, {}}, context.make_spool(),
                                         *context.threads),
                     Cancelled);
        EXPECT_EQ(asked, after + 1);
    }
}

}  // namespace
}  // namespace d2b::outline
