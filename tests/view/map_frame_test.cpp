#include "view/map_frame.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/height_classes.hpp"

namespace d2b::view {
namespace {

MapArea ground(const AffineTransform& transform, const CellSize& cell) {
    DemInfo dem;
    dem.rows = 50;
    dem.cols = 40;
    dem.window = {10, 20, 30, 10};
    dem.transform = transform;
    return {dem, Crs("EPSG:25833"), cell};
}

TEST(MapFrame, PlacesHaveTheirPixelsAndAllIsToScale) {
    // Cells twice as wide as high.
    const MapArea part = ground({1000, 2, 0, 500, 0, -1}, {2, 1, 1});
    EXPECT_NEAR(aspect_ratio(part), 20.0 / 30, 1e-12);
    const MapFrame frame(part, {200, 300});
    EXPECT_NEAR(frame.metres_per_pixel(), 0.1, 1e-12);
    const PixelPoint corner = frame.pixel({1040, 490});  // of the window
    EXPECT_NEAR(corner.x, 0, 1e-9);
    EXPECT_NEAR(corner.y, 0, 1e-9);
    const PixelPoint middle = frame.pixel({1050, 475});
    EXPECT_NEAR(middle.x, 100, 1e-9);
    EXPECT_NEAR(middle.y, 150, 1e-9);
    EXPECT_LE(frame.pixel({1e300, 0}).x, 1e6);
}

TEST(MapFrame, NorthIsUpOnAGridThatIsNotRotated) {
    for (const double x : {2.0, -2.0})
        for (const double y : {1.0, -1.0}) {
            const auto north = MapFrame(ground({1000, x, 0, 500, 0, y}, {2, 1, 1}), {200, 300}).north();
            ASSERT_TRUE(north);
            EXPECT_NEAR(north->x, 0, 1e-12);
            EXPECT_NEAR(north->y, -1, 1e-12);
        }
}

TEST(MapFrame, NorthTurnsWithTheGrid) {
    // Rows run to the north-east: up in the picture is north-west, so north is up and to the right.
    const double step = std::sqrt(0.5);
    const auto north = MapFrame(ground({0, step, step, 0, step, -step}, {1, 1, 1}), {100, 300}).north();
    ASSERT_TRUE(north);
    EXPECT_NEAR(north->x, step, 1e-12);
    EXPECT_NEAR(north->y, -step, 1e-12);
}

TEST(MapFrame, NobodyKnowsNorthWithoutACrs) {
    MapArea unknown = ground({0, 1, 0, 0, 0, -1}, {1, 1, 1});
    unknown.crs = Crs();
    EXPECT_FALSE(MapFrame(unknown, {10, 30}).north());
}

TEST(HeightClasses, AHeightIsInTheClassThatBeginsBelowIt) {
    EXPECT_EQ(height_class_of(-1), 0U);
    EXPECT_EQ(height_class_of(2.99), 0U);
    EXPECT_EQ(height_class_of(3), 1U);
    EXPECT_EQ(class_label(height_class_of(1000)), "100 m and more");
}

}  // namespace
}  // namespace d2b::view
