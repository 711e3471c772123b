// Values of the committed samples that were worked out by hand.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "sample_files.hpp"

namespace d2b::test {
namespace {

long count(const Raster& raster, float value) {
    return std::count(raster.z.begin(), raster.z.end(), value);
}

TEST(Values, WorkedExampleIsThePublishedOne) {
    const Raster raster = read_raster(D2B_SAMPLES, "thesis_11x7");
    const std::vector<float> expected{0, 0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  //
                                      0, 40, 40, 40, 40, 40, 40, 40, 40, 40, 0,  //
                                      0, 40, 40, 50, 50, 50, 50, 50, 40, 40, 0,  //
                                      0, 40, 40, 50, 50, 50, 50, 50, 40, 40, 0,  //
                                      0, 40, 40, 50, 50, 50, 50, 50, 40, 40, 0,  //
                                      0, 40, 40, 40, 40, 40, 40, 40, 40, 40, 0,  //
                                      0, 0,  0,  0,  0,  0,  0,  0,  0,  0,  0};
    EXPECT_EQ(raster.cols, 11);
    EXPECT_EQ(raster.rows, 7);
    EXPECT_EQ(raster.z, expected);
    EXPECT_EQ(raster.unit, "ft");
    EXPECT_EQ(raster.crs, "EPSG:26912");
    EXPECT_EQ(raster.transform[1], 1);
}

TEST(Values, WorkedExampleHasOneContourOf24Points) {
    const Raster raster = read_raster(D2B_SAMPLES, "thesis_11x7");
    const auto high = [&](int row, int col) { return raster.at(row, col) > 15; };
    std::vector<int> rim;
    for (int row = 1; row < 6; ++row) {
        for (int col = 1; col < 10; ++col) {
            const bool inner =
                high(row - 1, col) && high(row + 1, col) && high(row, col - 1) && high(row, col + 1);
            if (high(row, col) && !inner)
                rim.push_back(row * 11 + col);
        }
    }
    const std::vector<int> expected{12, 13, 14, 15, 16, 17, 18, 19, 20, 23, 31, 34,
                                    42, 45, 53, 56, 57, 58, 59, 60, 61, 62, 63, 64};
    EXPECT_EQ(rim, expected);
}

TEST(Values, DrawnGridHasARoundAnHAndAnL) {
    const Raster raster = read_raster(D2B_SAMPLES, "thesis_50x36");
    EXPECT_EQ(raster.cols, 50);
    EXPECT_EQ(raster.rows, 36);
    // Rows of half circles of radius 7 about a corner of cells: 2 (14 + 14 + 14 + 12 + 10 + 8 + 6).
    EXPECT_EQ(count(raster, 12), 156);
    // Two wings of 5 x 20 and a bar of 7 x 5.
    EXPECT_EQ(count(raster, 18), 235);
    // 18 x 4 and 4 x 6.
    EXPECT_EQ(count(raster, 8), 96);
    EXPECT_EQ(count(raster, 0), 50 * 36 - 156 - 235 - 96);
    EXPECT_EQ(raster.at(12, 12), 12);
    EXPECT_EQ(raster.at(12, 36), 18);
    EXPECT_EQ(raster.at(20, 36), 0);  // between the wings of the H
    EXPECT_EQ(raster.at(30, 20), 8);
    EXPECT_EQ(raster.at(25, 20), 0);  // in the angle of the L
}

TEST(Values, HotelHasItsDimensionsInFeet) {
    const Raster raster = read_raster(D2B_SAMPLES, "hotel_70x85");
    EXPECT_EQ(raster.cols, 70);
    EXPECT_EQ(raster.rows, 85);
    EXPECT_EQ(raster.unit, "ft");
    EXPECT_NEAR(*std::max_element(raster.z.begin(), raster.z.end()), 185, 0.75);
    const TruthLayer truth = truth_of("hotel_70x85");
    ASSERT_EQ(truth.footprints.size(), 1U);
    const Footprint& hotel = truth.footprints[0];
    EXPECT_DOUBLE_EQ(hotel.width_m, 53.6448);
    EXPECT_DOUBLE_EQ(hotel.length_m, 60.96);
    EXPECT_DOUBLE_EQ(hotel.eave_h, 135);
    EXPECT_DOUBLE_EQ(hotel.roof_h, 185);
    // Two wings of 56 x 200 and a bar of 64 x 56 square feet.
    EXPECT_NEAR(hotel.area, 25984 * 0.3048 * 0.3048, 1e-6);
    EXPECT_EQ(hotel.polygon->getExteriorRing()->getNumPoints(), 13);
}

TEST(Values, HotelHasBushesAtItsWallsAndNothingElse) {
    const Raster raster = read_raster(D2B_SAMPLES, "hotel_70x85");
    const TruthLayer truth = truth_of("hotel_70x85");
    const Footprint& hotel = truth.footprints.at(0);
    int bushes = 0;
    for (int row = 0; row < raster.rows; ++row) {
        for (int col = 0; col < raster.cols; ++col) {
            const OGRPoint p = raster.centre(row, col);
            if (hotel.contains(p))
                continue;
            EXPECT_LT(raster.at(row, col), 12.75F);
            if (raster.at(row, col) > 3) {
                ++bushes;
                EXPECT_LT(hotel.polygon->Distance(&p), 10);
            }
        }
    }
    EXPECT_GT(bushes, 150);
    EXPECT_LT(bushes, 700);
}

TEST(Values, CourtyardStandsOnASlopeOfEightPercent) {
    const Raster raster = read_raster(D2B_SAMPLES, "courtyard_utm");
    EXPECT_EQ(raster.crs, "EPSG:25832");
    EXPECT_EQ(raster.transform[1], 0.5);
    EXPECT_EQ(raster.transform[5], -0.5);
    // 510 + 0.064 x + 0.048 y at the centres of the corner cells and of a cell of the courtyard.
    EXPECT_NEAR(raster.at(139, 0), 510 + 0.016 + 0.012, 0.1);
    EXPECT_NEAR(raster.at(0, 0), 510 + 0.016 + 3.348, 0.1);
    EXPECT_NEAR(raster.at(0, 159), 510 + 5.104 + 3.348, 0.1);
    EXPECT_NEAR(raster.at(70, 80), 510 + 2.576 + 1.668, 0.1);
    EXPECT_DOUBLE_EQ(std::hypot(0.064, 0.048), 0.08);
}

TEST(Values, CourtyardIsTurnedBy27Degrees) {
    const TruthLayer truth = truth_of("courtyard_utm");
    ASSERT_EQ(truth.footprints.size(), 1U);
    const Footprint& block = truth.footprints[0];
    EXPECT_NEAR(block.area, 42 * 32 - 22 * 12, 1e-6);
    ASSERT_EQ(block.polygon->getNumInteriorRings(), 1);
    EXPECT_NEAR(block.polygon->getInteriorRing(0)->get_Area(), 22 * 12, 1e-6);
    const OGRLinearRing& ring = *block.polygon->getExteriorRing();
    const double angle = std::atan2(ring.getY(1) - ring.getY(0), ring.getX(1) - ring.getX(0));
    EXPECT_NEAR(angle * 180 / std::acos(-1.0), 27, 1e-6);
    // The origin of the scene is the raster's lower left corner; the ground at (40, 35).
    EXPECT_DOUBLE_EQ(block.ground, 510 + 2.56 + 1.68);
    EXPECT_DOUBLE_EQ(block.roof_h, 12 + 0.8 * 5);
}

TEST(Values, DegreesAreAboutAMetre) {
    const Raster raster = read_raster(D2B_SAMPLES, "degrees");
    EXPECT_EQ(raster.crs, "EPSG:4326");
    EXPECT_EQ(raster.unit, "m");
    EXPECT_DOUBLE_EQ(raster.transform[0], 13.4);
    EXPECT_DOUBLE_EQ(raster.transform[3], 52.0008);
    EXPECT_DOUBLE_EQ(raster.transform[1], 1.5e-5);
    EXPECT_DOUBLE_EQ(raster.transform[5], -1e-5);
    // The house of 14 m x 10 m, with 68678 m and 111267 m in a degree.
    const TruthLayer truth = truth_of("degrees");
    ASSERT_EQ(truth.footprints.size(), 4U);
    EXPECT_NEAR(truth.footprints[0].area * 68678 * 111267, 140, 1e-4);
}

TEST(Values, NodataHasALakeAndHoles) {
    const Raster raster = read_raster(D2B_SAMPLES, "nodata");
    ASSERT_TRUE(raster.has_nodata);
    EXPECT_EQ(raster.nodata, -9999);
    // The quay runs along x = 72, from the building to the water.
    EXPECT_EQ(raster.at(51, 72), -9999);
    EXPECT_EQ(raster.at(51, 88), -9999);
    EXPECT_GT(raster.at(51, 71), 38);
    EXPECT_TRUE(std::isnan(raster.at(80, 30)));
    EXPECT_TRUE(std::isnan(raster.at(7, 11)));
    // Ten cells of a gap; 5 rows x 4 columns of single holes, less the three of column 98 in the lake.
    EXPECT_EQ(std::count_if(raster.z.begin(), raster.z.end(), [](float z) { return std::isnan(z); }),
              10 + 20 - 3);
}

TEST(Values, NodataHasABuildingAtTheEdgeAndOneAtTheWater) {
    const TruthLayer truth = truth_of("nodata");
    const Raster raster = read_raster(D2B_SAMPLES, "nodata");
    ASSERT_EQ(truth.footprints.size(), 3U);
    OGREnvelope quay;
    OGREnvelope edge;
    truth.footprints[0].polygon->getEnvelope(&quay);
    truth.footprints[1].polygon->getEnvelope(&edge);
    EXPECT_EQ(quay.MaxX, raster.transform[0] + 72);
    EXPECT_EQ(edge.MinX, raster.transform[0]);
}

TEST(Values, TownIsASquareKilometreOfHills) {
    const Raster raster = read_raster(D2B_SAMPLES, "town");
    EXPECT_EQ(raster.cols, 1000);
    EXPECT_EQ(raster.rows, 1000);
    EXPECT_EQ(raster.crs, "EPSG:25833");
    EXPECT_EQ(raster.unit, "m");
    // Multiples of 1/64 m.
    EXPECT_TRUE(
        std::all_of(raster.z.begin(), raster.z.end(), [](float z) { return z * 64 == std::floor(z * 64); }));
    // The ground of the houses.
    const TruthLayer truth = truth_of("town");
    const auto [low, high] =
        std::minmax_element(truth.footprints.begin(), truth.footprints.end(),
                            [](const auto& a, const auto& b) { return a.ground < b.ground; });
    EXPECT_GT(high->ground - low->ground, 30);
    EXPECT_LT(high->ground - low->ground, 50);
}

}  // namespace
}  // namespace d2b::test
