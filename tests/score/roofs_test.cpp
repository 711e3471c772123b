#include "score/roofs.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "support/box.hpp"

namespace d2b::score {
namespace {

using namespace test;

double slope_of(double rise) {
    return std::atan(rise) * 180 / std::numbers::pi;
}

/// A face that rises from z at x = 0 and y = 0 by `east` and `north`.
RoofFace face(const Polygons& area, double z, double east = 0, double north = 0) {
    const double slope = slope_of(std::hypot(east, north));
    std::optional<double> azimuth;
    if (slope >= 8)
        azimuth = std::atan2(-east, -north) * 180 / std::numbers::pi;
    return {area, {{}, z, east, north}, slope, azimuth};
}

/// With angles as they are told, and level planes.
RoofFace told(double left, std::optional<double> slope, std::optional<double> azimuth, double breadth = 10) {
    return {{box(left, 0, left + breadth, 10)}, {{}, 10, 0, 0}, slope, azimuth};
}

RoofScore score_of(std::vector<RoofFace> found, std::vector<RoofFace> reference,
                   const RoofScoreOptions& options = {}) {
    return score_roofs({std::move(found), {}}, {std::move(reference), {}}, options);
}

TEST(Roofs, ofTwoLevelFacesThatOverlap) {
    const RoofScore result = score_of({face({box(2, 0, 12, 10)}, 20)}, {face({box(0, 0, 10, 10)}, 20.5)});
    EXPECT_NEAR(result.found_m2, 100, 1e-9);
    EXPECT_NEAR(result.reference_m2, 100, 1e-9);
    EXPECT_NEAR(result.shared_m2, 80, 1e-9);
    EXPECT_NEAR(result.covered, 0.8, 1e-12);
    EXPECT_NEAR(result.angles_right, 1, 1e-12);
    EXPECT_NEAR(result.heights_right, 1, 1e-12);
    EXPECT_NEAR(result.heights_iou, 80.0 / 120, 1e-12);
    EXPECT_EQ(result.slope->median_deg, 0);
    EXPECT_FALSE(result.azimuth);
    EXPECT_EQ(result.overlap, 0);
    EXPECT_EQ(result.found_faces, 1U);
}

TEST(Roofs, ofAGableWhoseRidgeIsShifted) {
    // True slopes of 45 degrees meet at x = 5, found ones at x = 6: over 1 m of 10 the found roof falls the
    // other way. On the left both are one plane. On the right the found plane is 2 m higher; over the shifted
    // strip the difference grows from 0 at x = 5 to 2 m at x = 6, and it is within 1 m in the first half.
    const RoofScore result = score_of({face({box(0, 0, 6, 10)}, 10, 1), face({box(6, 0, 10, 10)}, 22, -1)},
                                      {face({box(0, 0, 5, 10)}, 10, 1), face({box(5, 0, 10, 10)}, 20, -1)});
    EXPECT_NEAR(result.shared_m2, 100, 1e-9);
    EXPECT_NEAR(result.angles_right, 0.9, 1e-9);
    EXPECT_NEAR(result.slope->p90_deg, 0, 1e-9);
    EXPECT_NEAR(result.azimuth->median_deg, 0, 1e-9);
    EXPECT_NEAR(result.azimuth->p90_deg, 0, 1e-9);  // exactly nine tenths are right
    EXPECT_NEAR(result.heights_right, 0.55, 1e-6);
    EXPECT_NEAR(result.heights_iou, 0.55, 1e-6);
}

TEST(Roofs, areNearWhereTheDifferenceOfPlanesIsSmall) {
    const double rise = 0.08;  // 4.6 degrees
    const std::vector<RoofFace> level{face({box(0, 0, 20, 10)}, 10)};
    EXPECT_NEAR(score_of({face({box(0, 0, 20, 10)}, 10, rise)}, level).heights_right, 12.5 / 20, 1e-5);
    EXPECT_NEAR(score_of({face({box(0, 0, 20, 10)}, 10 - 20 * rise, rise)}, level).heights_right, 12.5 / 20,
                1e-5);
    // From 0.4 m below to 1.2 m above.
    EXPECT_NEAR(score_of({face({box(0, 0, 20, 10)}, 9.6, rise)}, level).heights_right, 17.5 / 20, 1e-5);
    // More than 5 degrees: nowhere, and yet both are level.
    const RoofScore steeper = score_of({face({box(0, 0, 20, 10)}, 10, 0.1)}, level);
    EXPECT_EQ(steeper.heights_right, 0);
    EXPECT_NEAR(steeper.angles_right, 1, 1e-12);
}

TEST(Roofs, areCutAcrossWingsAndCourtyards) {
    // A U of 150 m2 whose wings of 5 x 5 m are cut at y = 7.5.
    const Polygons u{{{{0, 0}, {20, 0}, {20, 10}, {15, 10}, {15, 5}, {5, 5}, {5, 10}, {0, 10}}, {}}};
    EXPECT_NEAR(score_of({face(u, 10.4, 0, 0.08)}, {face(u, 10)}).heights_right, 125.0 / 150, 1e-5);
    // A court of 6 x 6 m in 10 x 10 m: of the left half, 50 m2 less 3 x 6.
    const Polygons court{{box(0, 0, 10, 10).exterior, {{{2, 2}, {2, 8}, {8, 8}, {8, 2}}}}};
    EXPECT_NEAR(score_of({face(court, 10.6, 0.08)}, {face(court, 10)}).heights_right, 32.0 / 64, 1e-5);
}

TEST(Roofs, knowWhenAnglesAreRight) {
    struct Case {
        std::optional<double> slope, azimuth;
        double true_slope;
        std::optional<double> true_azimuth;
        bool right;
    };
    const std::vector<Case> cases{{7, {}, 1, {}, true},      // both are level
                                  {7, {}, 12, 90.0, true},   // one is: only slopes count
                                  {7, {}, 13, 90.0, false},  //
                                  {30, 100.0, 30, 90.0, true}, {30, 101.0, 30, 90.0, false},
                                  {30, 355.0, 30, 5.0, true},  {30, -5.0, 30, 365.0, true},
                                  {35, 90.0, 30, 90.0, true},  {36, 90.0, 30, 90.0, false},
                                  {30, {}, 30, 90.0, false},   {{}, {}, 0, {}, false}};
    for (const Case& one : cases) {
        const RoofScore result =
            score_of({told(0, one.slope, one.azimuth)}, {told(0, one.true_slope, one.true_azimuth)});
        EXPECT_EQ(result.angles_right, one.right ? 1 : 0)
            << one.slope.value_or(-1) << ", " << one.azimuth.value_or(-1);
    }
}

TEST(Roofs, withoutASlopeAreNeverRight) {
    const RoofScore result = score_of({told(0, {}, {}, 4), told(4, 0, {}, 6)}, {told(0, 0, {})});
    EXPECT_NEAR(result.without_slope, 0.4, 1e-12);
    EXPECT_NEAR(result.angles_right, 0.6, 1e-12);
    EXPECT_NEAR(result.heights_right, 0.6, 1e-12);
    EXPECT_EQ(result.slope->p90_deg, 0);
}

TEST(Roofs, weighErrorsByArea) {
    // Slopes are 1, 2 and 8 degrees off on 50, 39 and 11 m2 of 100; azimuths 3 and 20 on 50 and 39.
    const RoofScore result = score_of({told(0, 31, 93.0, 5), told(5, 32, 70.0, 3.9), told(8.9, 7, {}, 1.1)},
                                      {told(0, 30, 90.0, 8.9), told(8.9, 15, 90.0, 1.1)});
    EXPECT_NEAR(result.slope->median_deg, 1, 1e-9);
    EXPECT_NEAR(result.slope->p90_deg, 8, 1e-9);
    EXPECT_NEAR(result.azimuth->median_deg, 3, 1e-9);
    EXPECT_NEAR(result.azimuth->p90_deg, 20, 1e-9);
    EXPECT_NEAR(result.angles_right, 0.5, 1e-9);
}

TEST(Roofs, tellOfOverlapsOfFoundFaces) {
    const RoofScore result = score_of({face({box(0, 0, 6, 10)}, 10), face({box(4, 0, 10, 10)}, 10)},
                                      {face({box(0, 0, 10, 10)}, 10)});
    EXPECT_NEAR(result.overlap, 0.2, 1e-12);
    EXPECT_LE(result.covered, 1);
}

TEST(Roofs, lookInsideTheRegionAlone) {
    RoofScoreOptions options;
    options.region = Polygons{box(0, 0, 5, 10)};
    const RoofScore result = score_of({face({box(0, 0, 10, 10)}, 10), face({box(50, 0, 60, 10)}, 10)},
                                      {face({box(0, 0, 8, 10)}, 10)}, options);
    EXPECT_NEAR(result.found_m2, 50, 1e-9);
    EXPECT_NEAR(result.reference_m2, 50, 1e-9);
    EXPECT_NEAR(result.heights_iou, 1, 1e-9);
    EXPECT_EQ(result.found_faces, 2U);
}

TEST(Roofs, turnFeetIntoMetres) {
    RoofScoreOptions options;
    options.metres = 0.3048;
    // A rise of 0.08 metres per metre is 0.024384 m a foot: 1 m is reached after 41.01 of 100 ft.
    const RoofScore result =
        score_of({{{box(0, 0, 100, 100)}, {{}, 10, 0.08 * 0.3048, 0}, slope_of(0.08), {}}},
                 {{{box(0, 0, 100, 100)}, {{}, 10, 0, 0}, 0, {}}}, options);
    EXPECT_NEAR(result.shared_m2, 929.0304, 1e-6);
    EXPECT_NEAR(result.heights_right, 1 / (0.08 * 0.3048) / 100, 1e-5);
}

TEST(Roofs, ofNothingAreZero) {
    const RoofScore result = score_of({}, {face({box(0, 0, 10, 10)}, 10)});
    EXPECT_EQ(result.covered, 0);
    EXPECT_EQ(result.angles_right, 0);
    EXPECT_EQ(result.heights_iou, 0);
    EXPECT_FALSE(result.slope);
    EXPECT_EQ(score_of({}, {}).heights_iou, 0);
    EXPECT_EQ(score_of({face({box(0, 0, 10, 10)}, 10)}, {}).found_m2, 100);
}

TEST(RoofTypes, areThoseOfTheBuildingWithTheMostInCommon) {
    // The first: 60 m2 in a hipped one, 40 in a gabled one. The second: in a shed of 400 m2. The third: 40 m2
    // of 100 in a found one. The fourth is too small. The fifth is a dome that was taken for hips.
    const RoofSide found{{},
                         {{{box(0, 0, 6, 10)}, "hipped"},
                          {{box(6, 0, 10, 10)}, "gabled"},
                          {{box(20, 0, 40, 20)}, "shed"},
                          {{box(50, 0, 54, 10)}, "flat"},
                          {{box(90, 0, 100, 9)}, "hipped"}}};
    const RoofSide reference{{},
                             {{{box(0, 0, 10, 10)}, "gabled"},
                              {{box(20, 0, 30, 10)}, "shed"},
                              {{box(50, 0, 60, 10)}, "flat"},
                              {{box(70, 0, 77, 7)}, "flat"},
                              {{box(90, 0, 100, 10)}, "domed"}}};
    const RoofScore result = score_roofs(found, reference, {});
    EXPECT_EQ(result.buildings, 4U);
    EXPECT_EQ(result.compared, 3U);
    EXPECT_EQ(result.right, 1U);
    EXPECT_DOUBLE_EQ(result.type_right, 1.0 / 3);
    EXPECT_EQ(result.pairs, 2U);  // IoU of 0.6, 0.25 and 0.9
    EXPECT_EQ(result.pairs_right, 0U);
    const std::map<std::string, std::map<std::string, std::size_t>> types{
        {"domed", {{"hipped", 1}}}, {"gabled", {{"hipped", 1}}}, {"shed", {{"shed", 1}}}};
    EXPECT_EQ(result.types, types);
}

TEST(FittedPlane, goesThroughCornersFarFromTheOrigin) {
    // z = 50 + x / 2 - y / 4 from (500000, 5800000) on.
    const Polygons area{{{{500000, 5800000}, {500010, 5800000}, {500010, 5800008}, {500000, 5800008}},
                         {{{500002, 5800002}, {500002, 5800004}, {500004, 5800004}}}}};
    const std::vector<double> elevations{50, 55, 53, 48, 50.5, 50, 51};
    const RoofPlane plane = fitted_plane(area, elevations);
    EXPECT_NEAR(plane.east, 0.5, 1e-9);
    EXPECT_NEAR(plane.north, -0.25, 1e-9);
    EXPECT_NEAR(plane.at({500008, 5800004}), 53, 1e-9);
}

TEST(FittedPlane, isLevelOverALine) {
    const RoofPlane plane = fitted_plane({{{{0, 0}, {1, 1}, {2, 2}}, {}}}, std::vector<double>{0, 3, 6});
    EXPECT_EQ(plane.east, 0);
    EXPECT_EQ(plane.north, 0);
    EXPECT_EQ(plane.elevation, 3);
}

}  // namespace
}  // namespace d2b::score
