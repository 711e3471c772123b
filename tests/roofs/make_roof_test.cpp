#include "roofs/make_roof.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "roofs/made_roof.hpp"

namespace d2b::roofs {
namespace {

Roof roof_of(const MadeRoof& made, double metres = 1) {
    contours::BuildingCells cells = made.cells();
    for (double& z : cells.elevations)
        z /= metres;
    RoofParameters parameters;
    parameters.segments = {0.5, 4};
    parameters.cell = {1, 1};
    parameters.metres = metres;
    Geos geos;
    return make_roof(cells, made.outline(1), parameters, geos, {});
}

double share_of(const Roof& roof, FaceKind kind) {
    double share = 0;
    for (const RoofFace& face : roof.faces)
        share += face.measure.kind == kind ? face.measure.area : 0;
    return share;
}

TEST(MakeRoof, AFlatRoofIsItsFootprint) {
    const Roof roof = roof_of({12, 20, [](double, double) { return 8.0; }});
    EXPECT_EQ(roof.type, "flat");
    ASSERT_EQ(roof.faces.size(), 1U);
    const RoofFace& face = roof.faces[0];
    EXPECT_EQ(face.measure.kind, FaceKind::flat);
    EXPECT_DOUBLE_EQ(face.measure.area, 1);
    EXPECT_EQ(face.measure.cells, 240);
    EXPECT_NEAR(slope_degrees(face.measure), 0, 0.01);
    for (const double z : face.elevations)
        EXPECT_NEAR(z, 8, 1e-3);
    EXPECT_NEAR(roof.rmse_m, 0, 1e-3);
}

/// A slope of 0.7 is one of 34.99 degrees. Eaves lie 6 m beside the ridge, at 9 - 4.2 m.
TEST(MakeRoof, AGable) {
    const Roof roof = roof_of({12, 20, gable(16, 0.7)});
    EXPECT_EQ(roof.type, "gabled");
    ASSERT_EQ(roof.faces.size(), 2U);
    for (const RoofFace& face : roof.faces) {
        EXPECT_EQ(face.measure.kind, FaceKind::pitched);
        EXPECT_NEAR(slope_degrees(face.measure), 34.99, 0.1);
        EXPECT_NEAR(face.measure.area, 0.5, 0.005);
        const auto [low, high] = std::ranges::minmax(face.elevations);
        EXPECT_NEAR(low, 4.8, 0.02);
        EXPECT_NEAR(high, 9, 0.02);
    }
    EXPECT_LT(roof.rmse_m, 0.02);
}

TEST(MakeRoof, AShed) {
    const Roof roof = roof_of({12, 20, [](double, double col) { return 5 + 0.3 * (col - 20); }});
    EXPECT_EQ(roof.type, "shed");
    ASSERT_EQ(roof.faces.size(), 1U);
    EXPECT_NEAR(roof.faces[0].measure.slope_col, 0.3, 0.001);
    EXPECT_NEAR(roof.faces[0].measure.slope_row, 0, 0.001);
    EXPECT_NEAR(slope_degrees(roof.faces[0].measure), 16.70, 0.05);
}

/// The sides are trapezoids of 24 and 10 m and 7 m wide, the ends triangles.
TEST(MakeRoof, AHippedRoof) {
    const Roof roof = roof_of({14, 24, hip(14, 24, 0.6)});
    EXPECT_EQ(roof.type, "hipped");
    ASSERT_EQ(roof.faces.size(), 4U);
    std::vector<double> areas;
    for (const RoofFace& face : roof.faces) {
        areas.push_back(face.measure.area * 14 * 24);
        EXPECT_NEAR(slope_degrees(face.measure), 30.96, 0.2);
        EXPECT_NEAR(std::ranges::max(face.elevations), 5 + 0.6 * 7, 0.05);
        EXPECT_NEAR(std::ranges::min(face.elevations), 5, 0.05);
    }
    std::ranges::sort(areas);
    EXPECT_NEAR(areas[0], 49, 1.5);
    EXPECT_NEAR(areas[1], 49, 1.5);
    EXPECT_NEAR(areas[2], 119, 1.5);
    EXPECT_NEAR(areas[3], 119, 1.5);
}

TEST(MakeRoof, APyramid) {
    const Roof roof = roof_of({16, 16, hip(16, 16, 0.6)});
    EXPECT_EQ(roof.type, "pyramidal");
    EXPECT_EQ(roof.faces.size(), 4U);
}

/// The same building with elevations in feet, and the planes in metres.
TEST(MakeRoof, TheUnitOfElevationsChangesNothing) {
    const Roof metres = roof_of({12, 20, gable(16, 0.7)});
    const Roof feet = roof_of({12, 20, gable(16, 0.7)}, 0.3048);
    ASSERT_EQ(feet.faces.size(), metres.faces.size());
    for (std::size_t i = 0; i < feet.faces.size(); ++i) {
        EXPECT_NEAR(slope_degrees(feet.faces[i].measure), slope_degrees(metres.faces[i].measure), 1e-3);
        for (std::size_t k = 0; k < feet.faces[i].elevations.size(); ++k)
            EXPECT_NEAR(feet.faces[i].elevations[k], metres.faces[i].elevations[k], 1e-4);
    }
}

/// A shed two cells wide beside a roof has no slope that could be trusted.
TEST(MakeRoof, NarrowFacesAreDoubtful) {
    const Roof roof = roof_of({12, 20, [](double row, double) { return row < 12 ? 5.0 : 9.0; }});
    ASSERT_EQ(roof.faces.size(), 2U);
    EXPECT_NEAR(share_of(roof, FaceKind::doubtful), 2.0 / 12, 0.01);
    EXPECT_NEAR(share_of(roof, FaceKind::flat), 10.0 / 12, 0.01);
    EXPECT_EQ(roof.type, "flat");
}

/// Any plane is within half a metre of a third of these points at most.
TEST(MakeRoof, FacesFarFromTheirPointsAreDoubtful) {
    const Roof roof =
        roof_of({12, 20, [](double row, double col) { return 5 + 2 * std::fmod(std::floor(row + col), 3); }});
    EXPECT_NEAR(share_of(roof, FaceKind::doubtful), 1, 1e-9);
}

/// Tiers are level, whatever slopes the points have, and tile the footprint.
TEST(MakeRoof, TiersHaveNoSlope) {
    const MadeRoof made{12, 20, gable(16, 0.7)};
    RoofParameters parameters;
    parameters.tiers = contours::RegionOptions{0.25, 2, 12};
    Geos geos;
    const Roof roof = make_roof(made.cells(), made.outline(1), parameters, geos, {});
    EXPECT_GT(roof.faces.size(), 2U);
    double whole = 0;
    for (const RoofFace& face : roof.faces) {
        EXPECT_EQ(face.measure.kind, FaceKind::doubtful);
        EXPECT_EQ(slope_degrees(face.measure), 0);
        EXPECT_EQ(std::ranges::min(face.elevations), std::ranges::max(face.elevations));
        whole += face.measure.area;
    }
    EXPECT_NEAR(whole, 1, 1e-9);
    EXPECT_EQ(roof.type, "unknown");
}

/// Tiers between which a low step is left are not merged into a slanted face.
TEST(MakeRoof, TiersWithALowStepStayLevel) {
    const MadeRoof made{12, 20, [](double row, double) { return row < 16 ? 6.0 : 6.2; }};
    RoofParameters parameters;
    parameters.tiers = contours::RegionOptions{0.01, 2, 0};
    Geos geos;
    const Roof roof = make_roof(made.cells(), made.outline(1), parameters, geos, {});
    ASSERT_EQ(roof.faces.size(), 2U);
    for (const RoofFace& face : roof.faces)
        EXPECT_EQ(slope_degrees(face.measure), 0);
}

TEST(MakeRoof, WithoutAValidPointIsDoubtfulOrFlatButWhole) {
    const Roof roof = roof_of({12, 20, [](double, double) { return std::nan(""); }});
    ASSERT_EQ(roof.faces.size(), 1U);
    EXPECT_DOUBLE_EQ(roof.faces[0].measure.area, 1);
    EXPECT_EQ(roof.faces[0].measure.cells, 0);
    EXPECT_EQ(roof.faces[0].measure.kind, FaceKind::doubtful);
    EXPECT_EQ(roof.type, "unknown");
}

}  // namespace
}  // namespace d2b::roofs
