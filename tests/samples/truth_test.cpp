// The truth is sound and agrees with the rasters.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "sample_files.hpp"

namespace d2b::test {
namespace {

/// How the cells whose centres lie in a footprint compare with its heights.
struct Agreement {
    int cells = 0;
    int below = 0;  ///< under the eave
    int above = 0;  ///< over the ridge: trees that overhang
    double highest = -1e9;
};

Agreement compare(const Raster& raster, const Footprint& footprint, double tolerance) {
    OGREnvelope box;
    footprint.polygon->getEnvelope(&box);
    const auto col = [&](double x) {
        return static_cast<int>(std::floor((x - raster.transform[0]) / raster.transform[1]));
    };
    const auto row = [&](double y) {
        return static_cast<int>(std::floor((y - raster.transform[3]) / raster.transform[5]));
    };
    Agreement result;
    for (int r = std::max(0, row(box.MaxY)); r <= std::min(raster.rows - 1, row(box.MinY)); ++r) {
        for (int c = std::max(0, col(box.MinX)); c <= std::min(raster.cols - 1, col(box.MaxX)); ++c) {
            if (!footprint.contains(raster.centre(r, c)))
                continue;
            const float z = raster.at(r, c);
            if (std::isnan(z))
                continue;
            const double height = static_cast<double>(z) - footprint.ground;
            ++result.cells;
            result.below += height < footprint.eave_h - tolerance ? 1 : 0;
            result.above += height > footprint.roof_h + tolerance ? 1 : 0;
            result.highest = std::max(result.highest, height);
        }
    }
    return result;
}

class Truth : public testing::TestWithParam<const char*> {
  protected:
    const Raster raster_ = read_raster(D2B_SAMPLES, GetParam());
    const TruthLayer truth_ = truth_of(GetParam());
    const bool town_ = std::string(GetParam()) == "town";
};

TEST_P(Truth, PolygonsAreValidAndInsideTheRaster) {
    ASSERT_GE(truth_.footprints.size(), 1U);
    EXPECT_EQ(truth_.crs, raster_.crs);
    const double right = raster_.transform[0] + raster_.cols * raster_.transform[1];
    const double bottom = raster_.transform[3] + raster_.rows * raster_.transform[5];
    for (const Footprint& footprint : truth_.footprints) {
        EXPECT_TRUE(footprint.polygon->IsValid()) << footprint.fields;
        EXPECT_FALSE(footprint.polygon->getExteriorRing()->isClockwise()) << footprint.fields;
        OGREnvelope box;
        footprint.polygon->getEnvelope(&box);
        EXPECT_GE(box.MinX, raster_.transform[0]);
        EXPECT_LE(box.MaxX, right);
        EXPECT_GE(box.MinY, bottom);
        EXPECT_LE(box.MaxY, raster_.transform[3]);
        EXPECT_EQ(footprint.unit, raster_.unit);
    }
}

TEST_P(Truth, CellsStandAboveTheGroundByTheHeight) {
    const double tolerance =
        raster_.unit == "ft" ? 0.75 : 0.16;  // 3.5 standard deviations of the noise, rounding
    int cells = 0;
    int above = 0;
    for (const Footprint& footprint : truth_.footprints) {
        SCOPED_TRACE(footprint.fields);
        const Agreement found = compare(raster_, footprint, tolerance);
        EXPECT_GT(found.cells, 0);
        EXPECT_EQ(found.below, 0);
        // Something of the roof is seen near its highest point: ridges may pass between the centres of cells.
        EXPECT_GT(found.highest, footprint.eave_h + 0.6 * (footprint.roof_h - footprint.eave_h) - tolerance);
        cells += found.cells;
        above += found.above;
    }
    EXPECT_LE(above, town_ ? cells / 50 : 0);
}

TEST_P(Truth, BuildingsDoNotOverlap) {
    OGRMultiPolygon all;
    double sum = 0;
    for (const Footprint& footprint : truth_.footprints) {
        all.addGeometry(footprint.polygon.get());
        sum += footprint.area;
    }
    const std::unique_ptr<OGRGeometry> united(all.UnionCascaded());
    const double area = united->getGeometryType() == wkbPolygon ? united->toPolygon()->get_Area()
                                                                : united->toMultiPolygon()->get_Area();
    EXPECT_NEAR(sum / area, 1, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Samples, Truth,
                         testing::Values("thesis_50x36", "hotel_70x85", "courtyard_utm", "degrees", "nodata",
                                         "town"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST(TownTruth, DissolvedBlocksAreTheBuildingsWithoutSharedWalls) {
    const auto layers = read_truth(D2B_SAMPLES, "town_truth.gpkg");
    ASSERT_EQ(layers.size(), 2U);
    ASSERT_EQ(layers[1].name, "blocks_dissolved");
    const auto& buildings = layers[0].footprints;
    std::map<const Footprint*, double> built;
    for (const Footprint& house : buildings) {
        const std::unique_ptr<OGRGeometry> inner(house.polygon->Buffer(-1));
        const std::unique_ptr<OGRGeometry> within(
            OGRGeometry::FromHandle(OGR_G_PointOnSurface(OGRGeometry::ToHandle(inner.get()))));
        const OGRPoint& inside = *within->toPoint();
        const auto block =
            std::find_if(layers[1].footprints.begin(), layers[1].footprints.end(),
                         [&](const Footprint& candidate) { return candidate.contains(inside); });
        ASSERT_NE(block, layers[1].footprints.end()) << house.fields;
        built[&*block] += house.area;
    }
    EXPECT_EQ(built.size(), layers[1].footprints.size());
    EXPECT_LT(built.size(), buildings.size() / 2);
    for (const auto& [block, area] : built) {
        EXPECT_TRUE(block->polygon->IsValid());
        EXPECT_NEAR(block->area, area, 1e-5) << block->fields;
    }
}

TEST(WorkedExample, IsThePublishedOne) {
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

TEST(WorkedExample, HasOneContourOf24Points) {
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

}  // namespace
}  // namespace d2b::test
