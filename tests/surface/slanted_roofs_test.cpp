#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "surface/label_contours.hpp"
#include "surface/surface_check.hpp"

namespace d2b::surface {
namespace {

constexpr std::int64_t cell = FinePoint::steps;

/// Cells from a row and a column to others.
FinePolygon rectangle(std::int64_t top, std::int64_t left, std::int64_t bottom, std::int64_t right) {
    return {{{top * cell, left * cell},
             {bottom * cell, left * cell},
             {bottom * cell, right * cell},
             {top * cell, right * cell}},
            {}};
}

/// Plane through a height at a corner of cells, with rises per cell southwards and eastwards.
RoofPlane plane(std::int64_t row, std::int64_t col, double height, double south, double east) {
    const auto steps = static_cast<double>(cell);
    return {{row * cell, col * cell}, height, south / steps, east / steps, 1};
}

PartitionContour face(FinePolygon outline, const RoofPlane& roof, std::int64_t lowest,
                      std::int32_t building = 0) {
    return {std::move(outline), -1, building, lowest, roof};
}

/// Two slopes of 2 cells each that rise by 40 to a ridge of 6 cells, eaves at 30.
SurfaceCluster gable() {
    return {{face(rectangle(0, 0, 2, 6), plane(0, 0, 30, 20, 0), 30),
             face(rectangle(2, 0, 4, 6), plane(4, 0, 30, -20, 0), 30)},
            {{100, 0}}};
}

std::vector<std::int64_t> heights_of(const SurfacePart& part) {
    std::vector<std::int64_t> heights;
    for (const SurfacePoint& point : part.points)
        heights.push_back(point.z);
    std::ranges::sort(heights);
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    return heights;
}

std::ptrdiff_t count_of(const SurfacePart& part, FaceKind kind) {
    return std::ranges::count(part.buildings.front().faces, kind, &SurfaceFace::kind);
}

void expect_whole(const MadeSurfaces& made, double cell_heights) {
    EXPECT_TRUE(made.left_out.empty());
    EXPECT_EQ(fault_of(made.shell, true), "");
    for (const SurfacePart& solid : made.solids)
        EXPECT_EQ(fault_of({&solid, 1}, true), "");
    for (const auto* parts : {&made.shell, &made.solids})
        EXPECT_NEAR(static_cast<double>(six_volumes(*parts)) / 6 / (cell * cell), cell_heights,
                    1e-3 * cell_heights);
}

TEST(SlantedRoofs, aGableHasARidgeAndNoWallBelowIt) {
    const MadeSurfaces made = surfaces_of(gable());
    expect_whole(made, 24 * (30 + 20));
    ASSERT_EQ(made.solids.size(), 1U);
    const SurfacePart& solid = made.solids.front();
    // Of the ground, the eaves and the ridge; the ground has corners below the ridge's ends.
    EXPECT_EQ(solid.points.size(), 6U + 4U + 2U);
    EXPECT_EQ(heights_of(solid), (std::vector<std::int64_t>{0, 30, 70}));
    EXPECT_EQ(count_of(solid, FaceKind::roof), 2);
    EXPECT_EQ(count_of(solid, FaceKind::wall), 6);
    for (const SurfaceFace& one : solid.buildings.front().faces)
        EXPECT_EQ(one.roof >= 0, one.kind == FaceKind::roof);
    EXPECT_EQ(made.shell.front().points.size(), 12U);
}

/// The slopes meet only nearly, as after rounding: by less than a millimetre they are one ridge, by two they
/// are a step with a wall.
TEST(SlantedRoofs, nearlyMeetingSlopesShareTheirRidge) {
    for (const double off : {0.4, 1.1, 2.0}) {
        SurfaceCluster cluster = gable();
        cluster.contours[1].plane->height += off;
        const MadeSurfaces made = surfaces_of(cluster);
        EXPECT_EQ(fault_of(made.shell, true), "");
        EXPECT_EQ(fault_of(made.solids, true), "");
        EXPECT_EQ(count_of(made.solids.front(), FaceKind::wall), off < 1.2 ? 6 : 7) << off;
    }
}

/// The western slope falls southwards from 70 to 30, the eastern one rises from 40 to 60: they are equal at
/// 50 in the middle of their border, below which there are two triangles.
TEST(SlantedRoofs, aNodeWhereTwoRoofsCross) {
    SurfaceCluster cluster{{face(rectangle(0, 0, 4, 3), plane(0, 0, 70, -10, 0), 30),
                            face(rectangle(0, 3, 4, 5), plane(0, 3, 40, 5, 0), 40)},
                           {{100, 0}}};
    const MadeSurfaces made = surfaces_of(cluster);
    expect_whole(made, 12 * 50 + 8 * 50);
    const SurfacePart& solid = made.solids.front();
    const auto crossing = std::ranges::find(solid.points, SurfacePoint{3 * cell, -2 * cell, 50});
    EXPECT_NE(crossing, solid.points.end());
    EXPECT_EQ(std::ranges::count_if(solid.buildings.front().faces,
                                    [](const SurfaceFace& one) {
                                        return one.kind == FaceKind::wall && one.exterior.size() == 3;
                                    }),
              2);
}

/// A slope against a block of another building: the wall between them changes sides where the slope passes
/// the block's roof at 50.
TEST(SlantedRoofs, aSlopePassesTheRoofOfANeighbour) {
    SurfaceCluster cluster{{face(rectangle(0, 0, 4, 3), plane(0, 0, 70, -10, 0), 30)}, {{100, 0}, {101, 0}}};
    cluster.contours.push_back({rectangle(0, 3, 4, 5), -1, 1, 50, {}});
    const MadeSurfaces made = surfaces_of(cluster);
    expect_whole(made, 12 * 50 + 8 * 50);
    ASSERT_EQ(made.shell.size(), 1U);
    ASSERT_EQ(made.solids.size(), 2U);
    EXPECT_EQ(made.solids[1].points.size(), 8U + 2U);  // with the crossing, above and below
}

/// Two of four slopes around a point are above the others there: corners that touch are moved apart.
TEST(SlantedRoofs, slopesThatTouchInAPoint) {
    SurfaceCluster cluster{{face(rectangle(0, 0, 2, 2), plane(2, 2, 60, -5, -5), 60),
                            face(rectangle(0, 2, 2, 4), plane(2, 2, 30, 1, 1), 28),
                            face(rectangle(2, 2, 4, 4), plane(2, 2, 60, 5, 5), 60),
                            face(rectangle(2, 0, 4, 2), plane(2, 2, 30, 1, 1), 28)},
                           {{100, 0}}};
    const MadeSurfaces made = surfaces_of(cluster);
    EXPECT_EQ(made.repairs.size(), 1U);
    EXPECT_EQ(fault_of(made.solids, true), "");
    EXPECT_EQ(fault_of(made.shell, true), "");
}

/// A slope that dives into the ground cannot stand: its building is left out.
TEST(SlantedRoofs, aSlopeBelowItsBase) {
    SurfaceCluster cluster = gable();
    cluster.buildings[0].base = 31;
    const MadeSurfaces made = surfaces_of(cluster);
    EXPECT_EQ(made.left_out, (std::vector<std::int64_t>{100}));
    EXPECT_TRUE(made.solids.empty());
}

/// Where a level roof is 1.15 steps lower, the slope takes its height, which is off the plane of the other
/// corners.
TEST(SlantedRoofs, aCornerOffThePlaneOfTheOthers) {
    const auto beside = [](std::int64_t level) {
        SurfaceCluster cluster{{face(rectangle(0, 0, 4, 8), plane(4, 3, 11.15, 0, 5.3), -5)},
                               {{100, -10}, {101, -10}}};
        for (std::int64_t col = 0; col < 8; ++col)
            cluster.contours.push_back({rectangle(-1, col, 0, col + 1), -1, 1, 100 + 10 * (col % 2), {}});
        for (std::int64_t col = 0; col < 8; ++col)
            cluster.contours.push_back(
                {rectangle(4, col, 5, col + 1), -1, 1, col == 3 ? level : 100 + 10 * (col % 2), {}});
        return surfaces_of(cluster).left_out;
    };
    EXPECT_EQ(beside(10), (std::vector<std::int64_t>{100}));
    EXPECT_EQ(beside(7), std::vector<std::int64_t>());
}

}  // namespace
}  // namespace d2b::surface
