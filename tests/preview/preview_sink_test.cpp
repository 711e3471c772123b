#include "preview/preview_sink.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "core/height_classes.hpp"
#include "support/memory_io.hpp"

namespace d2b::test {
namespace {

/// 20 x 20 cells of 1 m, flat but for a slope to the south-east in the last rows; two points are not valid.
std::vector<double> field() {
    std::vector<double> z(400, 5);
    z[0] = z[1] = std::numeric_limits<double>::quiet_NaN();
    for (int row = 15; row < 20; ++row)
        for (int col = 0; col < 20; ++col)
            z[static_cast<std::size_t>(row * 20 + col)] = 5.0 - (row - 14);
    return z;
}

LayerSpec layer(const std::string& name, const std::string& order) {
    LayerSpec spec;
    spec.name = name;
    spec.fields = {{"id", "", FieldType::integer, "", ""}, {"height", "", FieldType::real, "m", ""}};
    spec.style.colour = "height";
    spec.style.order = order;
    return spec;
}

Feature square(double x, double y, double side, double height) {
    return {
        {std::int64_t{1}, height}, {{{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}, {}}}, 0};
}

class PreviewTest : public ::testing::Test {
  protected:
    Image draw(const std::vector<LayerSpec>& layers,
               const std::vector<std::pair<std::size_t, Feature>>& features) {
        Image image;
        PreviewSink sink(inner, dem, Crs(), {.longest = 200, .heading = "", .vertical_metres = 1},
                         [&](const Image& taken) {
                             EXPECT_FALSE(inner.finished);
                             image = taken;
                         });
        sink.begin(layers, {});
        for (const auto& [index, feature] : features)
            sink.add(index, feature);
        sink.take_report({});
        sink.finish();
        return image;
    }

    void SetUp() override { dem.edit().transform = {0, 1, 0, 20, 0, -1}; }

    MemorySource dem{20, 20, field()};
    MemorySink inner;
};

TEST_F(PreviewTest, FeaturesGoOnAndAreDrawnWhereTheyLie) {
    const Image image = draw({layer("buildings", "")}, {{0, square(5, 10, 5, 12)}});
    EXPECT_TRUE(inner.finished);
    ASSERT_EQ(inner.features.at(0).size(), 1U);
    EXPECT_EQ(image.width, 200);
    EXPECT_GT(image.height, 210);
    // Ten pixels a cell, and north is up.
    EXPECT_EQ(image.at(75, 75), height_classes()[3].colour);
    EXPECT_EQ(image.at(75, 45)[0], image.at(75, 45)[2]);
    EXPECT_EQ(image.at(75, 105)[0], image.at(75, 105)[2]);
    EXPECT_EQ(image.at(3, 3), (Colour{255, 255, 255}));     // not valid
    EXPECT_LT(image.at(75, 175)[0], image.at(75, 130)[0]);  // away from the light
}

TEST_F(PreviewTest, ContoursAreDrawnAndNotTheBuildingsBelow) {
    const Image image =
        draw({layer("buildings", ""), layer("contours", "level")},
             {{0, square(5, 10, 5, 60)}, {1, square(5, 10, 5, 12)}, {1, square(6, 11, 2, 25)}});
    EXPECT_EQ(image.at(95, 60), height_classes()[3].colour);
    EXPECT_EQ(image.at(70, 80), height_classes()[5].colour);
}

TEST_F(PreviewTest, WhatHasNoHeightIsNotDrawn) {
    Feature root = square(0, 0, 20, 0);
    root.values[1] = FieldValue{};
    const Image image = draw({layer("contours", "level")}, {{0, root}});
    EXPECT_EQ(image.at(75, 75)[0], image.at(75, 75)[2]);
}

TEST_F(PreviewTest, NorthIsUpWhicheverWayRowsAndColumnsRun) {
    const std::vector<std::pair<std::size_t, Feature>> features{{0, square(5, 10, 5, 12)}};
    const Image expected = draw({layer("buildings", "")}, features);
    const auto expect_same = [&](std::vector<double> z, const AffineTransform& transform) {
        MemorySource other(20, 20, std::move(z));
        other.edit().transform = transform;
        Image image;
        MemorySink sink;
        PreviewSink preview(sink, other, Crs(), {.longest = 200, .heading = "", .vertical_metres = 1},
                            [&](const Image& taken) { image = taken; });
        preview.begin(std::vector{layer("buildings", "")}, {});
        preview.add(0, features[0].second);
        preview.take_report({});
        preview.finish();
        EXPECT_EQ(image.rgb, expected.rgb);
    };
    const std::vector<double> z = field();
    std::vector<double> mirrored = z;
    for (auto row = mirrored.begin(); row != mirrored.end(); row += 20)
        std::reverse(row, row + 20);
    expect_same(mirrored, {20, -1, 0, 20, 0, -1});
    expect_same({mirrored.rbegin(), mirrored.rend()}, {0, 1, 0, 0, 0, 1});  // rows from below
    expect_same({z.rbegin(), z.rend()}, {20, -1, 0, 0, 0, 1});
}

}  // namespace
}  // namespace d2b::test
