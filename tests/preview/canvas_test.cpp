#include "preview/canvas.hpp"

#include <gtest/gtest.h>

#include "core/height_classes.hpp"
#include "preview/contact_sheet.hpp"
#include "preview/map_frame.hpp"

namespace d2b::test {
namespace {

constexpr Colour white{255, 255, 255};
constexpr Colour red{200, 0, 0};
using Rings = std::vector<std::vector<Spot>>;

TEST(Canvas, FillsWhatAnOddNumberOfRingsGoesRound) {
    Canvas canvas(10, 8, white);
    canvas.fill(Rings{{{1, 1}, {9, 1}, {9, 7}, {1, 7}}, {{3, 3}, {5, 3}, {5, 5}, {3, 5}}}, red);
    const Image image = canvas.shown();
    ASSERT_EQ(image.rgb.size(), 240U);
    int filled = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 10; ++x)
            filled += image.at(x, y) == red ? 1 : 0;
    EXPECT_EQ(filled, 8 * 6 - 2 * 2);
    EXPECT_EQ(image.at(4, 4), white);
    EXPECT_EQ(image.at(0, 0), white);
}

TEST(Canvas, HalfAPixelIsHalfTheColour) {
    Canvas canvas(2, 1, white);
    canvas.fill(Rings{{{0.5, 0}, {2, 0}, {2, 1}, {0.5, 1}}}, Colour{55, 55, 55});
    EXPECT_EQ(canvas.shown().at(0, 0), (Colour{155, 155, 155}));
    EXPECT_EQ(canvas.shown().at(1, 0), (Colour{55, 55, 55}));
}

TEST(Canvas, WhatIsOutsideIsLeftOut) {
    Canvas canvas(3, 3, white);
    const std::vector<Spot> far{{-1e7, -1e7}, {1e7, -1e7}, {1e7, 1e7}, {-1e7, 1e7}};
    canvas.fill(Rings{far}, red);
    canvas.outline(far, white);
    canvas.text(-50, 50, 4, "out", white);
    EXPECT_EQ(canvas.shown().at(1, 1), red);
}

TEST(Canvas, LettersStandWhereTheyShould) {
    Canvas canvas(8, 6, white);
    canvas.text(0, 0, 1, "l1", red);
    const Image image = canvas.shown();
    EXPECT_EQ(image.at(0, 0), red);  // the stem of an L
    EXPECT_EQ(image.at(2, 0), white);
    EXPECT_EQ(image.at(2, 4), red);  // its foot
    EXPECT_EQ(image.at(5, 0), red);  // the 1
    EXPECT_EQ(text_width(2, "l1"), 16);
}

TEST(ContactSheet, HoldsItsPicturesRowByRow) {
    const auto picture = [](std::uint8_t grey) { return Image{2, 1, std::vector<std::uint8_t>(6, grey)}; };
    const Image sheet = contact_sheet({picture(1), picture(2), picture(3)}, 2);
    EXPECT_EQ(sheet.width, 2 + 4 + 2);
    EXPECT_EQ(sheet.height, 1 + 4 + 1);
    EXPECT_EQ(sheet.at(0, 0)[0], 1);
    EXPECT_EQ(sheet.at(7, 0)[0], 2);
    EXPECT_EQ(sheet.at(1, 5)[0], 3);
    EXPECT_NE(sheet.at(3, 0)[0], 2);
    EXPECT_EQ(sheet.at(6, 5), sheet.at(3, 0));
    EXPECT_EQ(sheet.rgb.size(), 8U * 6 * 3);
}

TEST(MapFrame, CellsKeepTheirShapeAndPlacesTheirPixels) {
    DemInfo dem;
    dem.rows = 50;
    dem.cols = 40;
    dem.window = {10, 20, 30, 10};
    dem.transform = {1000, 2, 0, 500, 0, -1};  // cells twice as wide as high
    const MapFrame frame(dem, 300);
    EXPECT_EQ(frame.width(), 200);
    EXPECT_EQ(frame.height(), 300);
    const Spot corner = frame.spot({1040, 490});  // of the window
    EXPECT_NEAR(corner.x, 0, 1e-9);
    EXPECT_NEAR(corner.y, 0, 1e-9);
    const Spot middle = frame.spot({1050, 475});
    EXPECT_NEAR(middle.x, 100, 1e-9);
    EXPECT_NEAR(middle.y, 150, 1e-9);
}

TEST(HeightClasses, AHeightIsInTheClassThatBeginsBelowIt) {
    EXPECT_EQ(height_class_of(-1), 0U);
    EXPECT_EQ(height_class_of(2.99), 0U);
    EXPECT_EQ(height_class_of(3), 1U);
    EXPECT_EQ(class_label(height_class_of(1000)), "100 m and more");
}

}  // namespace
}  // namespace d2b::test
