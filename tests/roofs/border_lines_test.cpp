#include "roofs/border_lines.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "roofs/made_roof.hpp"

namespace d2b::roofs {
namespace {

/// Borders of labels that are given by cell.
std::vector<BorderLine> lines_of(const BuildingGrid& grid, const std::vector<Plane>& planes,
                                 const std::function<int(double row, double col)>& label) {
    std::vector<std::int32_t> labels(grid.size(), -1);
    for (std::int32_t row = 0; row < grid.rows; ++row)
        for (std::int32_t col = 0; col < grid.cols; ++col)
            if (const std::size_t i = grid.index(row, col); grid.inside[i] != 0)
                labels[i] = label(grid.first_row + row + 0.5, grid.first_col + col + 0.5);
    return border_lines(grid, nearest_labels(labels, grid.rows, grid.cols), planes, {});
}

/// The planes meet at row 15.8, although the labels change at 16.
TEST(BorderLines, ARidgeLiesWhereItsPlanesMeet) {
    const BuildingGrid grid = MadeRoof{12, 20, gable(15.8, 0.7)}.grid();
    const std::vector<Plane> planes{plane_of(grid, 15.8, 0, 9, 0.7, 0), plane_of(grid, 15.8, 0, 9, -0.7, 0)};
    const auto lines = lines_of(grid, planes, [](double row, double) { return row < 16 ? 0 : 1; });
    ASSERT_EQ(lines.size(), 1U);
    double left = lines[0].from.x;
    double right = lines[0].to.x;
    if (left > right)
        std::swap(left, right);
    for (const Vec2& end : {lines[0].from, lines[0].to})
        EXPECT_NEAR(grid.row(end.y) + grid.first_row, 15.8, 0.05);
    // It crosses the outline on both sides.
    EXPECT_LT(grid.col(left) + grid.first_col, MadeRoof::first_col);
    EXPECT_GT(grid.col(right) + grid.first_col, MadeRoof::first_col + 20);
}

/// Planes that never meet: the border is the line between the labels.
TEST(BorderLines, AStepLiesBetweenTheCells) {
    const BuildingGrid grid =
        MadeRoof{12, 20, [](double, double col) { return col < 29 ? 6.0 : 9.0; }}.grid();
    const std::vector<Plane> planes{plane_of(grid, 0, 0, 6, 0, 0), plane_of(grid, 0, 0, 9, 0, 0)};
    const auto lines = lines_of(grid, planes, [](double, double col) { return col < 29 ? 0 : 1; });
    ASSERT_EQ(lines.size(), 1U);
    for (const Vec2& end : {lines[0].from, lines[0].to})
        EXPECT_NEAR(grid.col(end.x) + grid.first_col, 29, 0.05);
}

/// An oblique step is a staircase of cells, but one line, also where each cell off it costs much.
TEST(BorderLines, AnObliqueStepIsOneLine) {
    for (const double slope : {1 / 3.0, 0.7, 1.0}) {
        const auto beyond = [slope](double row, double col) { return col - 23 > (row - 10) * slope; };
        const BuildingGrid grid =
            MadeRoof{18, 25, [&](double row, double col) { return beyond(row, col) ? 12.0 : 6.0; }}.grid();
        const std::vector<Plane> planes{plane_of(grid, 0, 0, 6, 0, 0), plane_of(grid, 0, 0, 12, 0, 0)};
        const auto lines =
            lines_of(grid, planes, [&](double row, double col) { return beyond(row, col) ? 1 : 0; });
        ASSERT_GE(lines.size(), 1U);
        ASSERT_LE(lines.size(), 3U) << slope;
        for (const BorderLine& line : lines)
            for (const Vec2& end : {line.from, line.to}) {
                const double row = grid.row(end.y) + grid.first_row;
                if (row < 11 || row > 27)
                    continue;
                EXPECT_NEAR(grid.col(end.x) + grid.first_col, 23 + (row - 10) * slope, 0.75);
            }
    }
}

TEST(BorderLines, OneFaceHasNone) {
    const BuildingGrid grid = MadeRoof{12, 20, [](double, double) { return 6.0; }}.grid();
    EXPECT_TRUE(lines_of(grid, {plane_of(grid, 0, 0, 6, 0, 0)}, [](double, double) { return 0; }).empty());
}

}  // namespace
}  // namespace d2b::roofs
