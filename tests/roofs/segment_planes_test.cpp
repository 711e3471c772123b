#include "roofs/segment_planes.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "roofs/made_roof.hpp"

namespace d2b::roofs {
namespace {

PlaneSegments segments_of(const BuildingGrid& grid, double min_area_m2 = 4) {
    return segment_planes(grid, {0.5, min_area_m2}, {});
}

TEST(SegmentPlanes, AFlatRoofIsOnePlane) {
    const BuildingGrid grid = MadeRoof{12, 15, [](double, double) { return 8.0; }}.grid();
    const PlaneSegments found = segments_of(grid);
    ASSERT_EQ(found.planes.size(), 1U);
    EXPECT_EQ(labels_inside(grid, found.labels), std::vector<std::int32_t>(180, 0));
    EXPECT_NEAR(found.planes[0].at(3, 2) + grid.datum, 8, 1e-6);
    for (std::size_t i = 0; i < grid.size(); ++i)
        EXPECT_EQ(found.labels[i] < 0, grid.inside[i] == 0);
}

TEST(SegmentPlanes, AGableIsTwoPlanesThatMeetInItsRidge) {
    const BuildingGrid grid = MadeRoof{12, 20, gable(16, 0.7)}.grid();
    const PlaneSegments found = segments_of(grid);
    ASSERT_EQ(found.planes.size(), 2U);
    std::vector<std::int32_t> expected(120, 0);
    expected.resize(240, 1);
    EXPECT_EQ(labels_inside(grid, found.labels), expected);
    EXPECT_NEAR(found.planes[0].slope_y, 0.7, 1e-3);
    EXPECT_NEAR(found.planes[1].slope_y, -0.7, 1e-3);
    EXPECT_NEAR(found.planes[0].slope_x, 0, 1e-3);
}

/// Each cell has the plane of its side, other than beside a hip, where two planes are equally good.
TEST(SegmentPlanes, AHippedRoofIsFourPlanes) {
    constexpr std::int32_t rows = 14;
    constexpr std::int32_t cols = 24;
    const BuildingGrid grid = MadeRoof{rows, cols, hip(rows, cols, 0.6)}.grid();
    const PlaneSegments found = segments_of(grid);
    ASSERT_EQ(found.planes.size(), 4U);
    const std::vector<std::int32_t> labels = labels_inside(grid, found.labels);
    std::array<std::set<std::int32_t>, 4> of_side;
    for (std::int32_t row = 0; row < rows; ++row)
        for (std::int32_t col = 0; col < cols; ++col) {
            const std::array<double, 4> from{row + 0.5, rows - row - 0.5, col + 0.5, cols - col - 0.5};
            const auto nearest = std::ranges::min_element(from);
            if (std::ranges::count_if(from, [&](double d) { return d < *nearest + 1; }) == 1)
                of_side[static_cast<std::size_t>(nearest - from.begin())].insert(
                    labels[static_cast<std::size_t>(row * cols + col)]);
        }
    std::set<std::int32_t> all;
    for (const std::set<std::int32_t>& side : of_side) {
        EXPECT_EQ(side.size(), 1U);
        all.insert(side.begin(), side.end());
    }
    EXPECT_EQ(all.size(), 4U);
}

/// A penthouse of 6 x 6 m stands 3 m above the roof.
TEST(SegmentPlanes, AStepIsABorderAndSmallFacesAreMerged) {
    const auto house = [](double row, double col) {
        return row > 14 && row < 20 && col > 26 && col < 32 ? 11.0 : 8.0;
    };
    const BuildingGrid grid = MadeRoof{16, 20, house}.grid();
    const PlaneSegments found = segments_of(grid);
    ASSERT_EQ(found.planes.size(), 2U);
    std::vector<std::int32_t> expected;
    for (int row = 10; row < 26; ++row)
        for (int col = 20; col < 40; ++col)
            expected.push_back(house(row + 0.5, col + 0.5) > 10 ? 1 : 0);
    EXPECT_EQ(labels_inside(grid, found.labels), expected);
    EXPECT_EQ(segments_of(grid, 40).planes.size(), 1U);
}

TEST(SegmentPlanes, PointsThatAreNotValidBelongToTheirSurroundings) {
    MadeRoof roof{12, 20, gable(16, 0.7)};
    roof.height = [whole = roof.height](double row, double col) {
        return std::fmod(row * 7 + col * 3, 11) < 2 ? std::numeric_limits<double>::quiet_NaN()
                                                    : whole(row, col);
    };
    const BuildingGrid grid = roof.grid();
    const PlaneSegments found = segments_of(grid);
    ASSERT_EQ(found.planes.size(), 2U);
    EXPECT_NEAR(found.planes[0].slope_y, 0.7, 1e-3);
}

/// Noise of 5 cm, and a chimney.
TEST(SegmentPlanes, NoiseAndAChimneyChangeNoPlane) {
    std::mt19937 random(1);
    const auto noise = [&] { return 0.1 * (static_cast<double>(random() % 1000) / 1000 - 0.5); };
    MadeRoof roof{12, 20, gable(16, 0.7)};
    roof.height = [&, whole = roof.height](double row, double col) {
        return row == 13.5 && col == 25.5 ? 11.0 : whole(row, col) + noise();
    };
    const PlaneSegments found = segments_of(roof.grid());
    ASSERT_EQ(found.planes.size(), 2U);
    EXPECT_NEAR(found.planes[0].slope_y, 0.7, 0.02);
    EXPECT_NEAR(found.planes[1].slope_y, -0.7, 0.02);
}

}  // namespace
}  // namespace d2b::roofs
