#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "surface/label_contours.hpp"
#include "surface/surface_check.hpp"

namespace d2b {
namespace {

LetterGrid random_grid(std::mt19937& random, const std::string& letters) {
    const auto up_to = [&](unsigned most) { return static_cast<int>(random() % most); };
    LetterGrid grid;
    const int rows = 1 + up_to(9);
    const int cols = 1 + up_to(9);
    for (int row = 0; row < rows; ++row) {
        std::string& line = grid.rows.emplace_back();
        for (int col = 0; col < cols; ++col)
            line += letters[static_cast<std::size_t>(up_to(static_cast<unsigned>(letters.size())))];
    }
    return grid;
}

/// As text, for messages.
std::string shown(const LetterGrid& grid) {
    std::string text = "\n";
    for (const std::string& row : grid.rows)
        text += row + "|\n";
    return text;
}

/// Whatever the grid: both forms are closed, nothing is left out, and areas and volumes are those of the
/// cells but for what mends take.
void expect_surfaces(const LetterGrid& grid, const SurfaceCluster& cluster, double cells, double heights) {
    const MadeSurfaces made = surfaces_of(cluster);
    ASSERT_EQ(fault_of(made.shell), "") << shown(grid);
    for (const SurfacePart& solid : made.solids)
        ASSERT_EQ(fault_of({&solid, 1}), "") << shown(grid);
    ASSERT_TRUE(made.left_out.empty()) << shown(grid);
    constexpr double cell = static_cast<double>(FinePoint::steps) * static_cast<double>(FinePoint::steps);
    // A mend moves a corner by two steps, and with it edges of some cells.
    const double slack = 0.01 * static_cast<double>(made.repairs.size()) * 4;
    ASSERT_NEAR(static_cast<double>(twice_plan_area(made.shell, FaceKind::roof)) / 2 / cell, cells, slack)
        << shown(grid);
    ASSERT_NEAR(static_cast<double>(six_volumes(made.shell)) / 6 / cell, heights, 100 * slack) << shown(grid);
    ASSERT_NEAR(static_cast<double>(six_volumes(made.solids)) / 6 / cell, heights, 100 * slack)
        << shown(grid);
    if (made.repairs.empty()) {
        ASSERT_EQ(static_cast<double>(six_volumes(made.shell)), 6 * cell * heights);
    }
}

TEST(RandomGrids, blocks) {
    std::mt19937 random(1);
    const std::vector<std::int64_t> heights{20, 35, 35, 60};
    for (int run = 0; run < 700; ++run) {
        const LetterGrid grid = random_grid(random, run % 2 == 0 ? "abcd" : "ab  c");
        double cells = 0;
        double sum = 0;
        for (const std::string& row : grid.rows)
            for (const char letter : row)
                if (letter != ' ') {
                    ++cells;
                    sum += static_cast<double>(heights[static_cast<std::size_t>(letter - 'a')]);
                }
        expect_surfaces(grid, blocks_of(grid, heights), cells, sum);
    }
}

TEST(RandomGrids, stacks) {
    std::mt19937 random(2);
    for (int run = 0; run < 700; ++run) {
        const LetterGrid grid = random_grid(random, run % 3 == 0 ? "123" : run % 3 == 1 ? "0124" : "111152");
        double cells = 0;
        double sum = 0;
        for (const std::string& row : grid.rows)
            for (const char digit : row) {
                cells += digit > '0' ? 1 : 0;
                sum += 10 * (digit - '0');
            }
        expect_surfaces(grid, stacks_of(grid), cells, sum);
    }
}

}  // namespace
}  // namespace d2b
