#include "view/preview_sink.hpp"

#include <cmath>
#include <optional>

#include "core/height_classes.hpp"
#include "support/memory_io.hpp"
#include "view/field.hpp"
#include "view/map_page.hpp"
#include "view/page.hpp"
#include "view/pixels.hpp"

namespace d2b::view {
namespace {

using namespace test;

LayerSpec layer(const std::string& name, const std::string& order) {
    LayerSpec spec;
    spec.name = name;
    spec.fields = {{"id", "", FieldType::integer, "", ""}, {"p90", "", FieldType::real, "m", ""}};
    spec.style.title = "Height of " + name;
    spec.style.colour = "p90";
    spec.style.order = order;
    return spec;
}

Feature square(double x, double y, double side, double height) {
    return {
        {std::int64_t{1}, height}, {{{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}, {}}}, 0};
}

/// The colour of a class on level ground.
Colour seen(std::size_t height_class) {
    Colour colour = height_classes()[height_class].colour;
    for (std::size_t i = 0; i < colour.size(); ++i)
        colour[i] = static_cast<std::uint8_t>(
            std::lround(colour[i] * footprint_opacity + level_ground[i] * (1 - footprint_opacity)));
    return colour;
}

/// Level ground of 20 x 20 m, ten pixels a metre.
class PreviewTest : public ::testing::Test {
  protected:
    MapPicture picture(const std::vector<LayerSpec>& layers,
                       const std::vector<std::pair<std::size_t, Feature>>& features,
                       writing::PictureFormat format = writing::PictureFormat::png) {
        const MapArea ground = field(20, 20, {}, {0, 1, 0, 20, 0, -1});
        inner.finished = false;
        std::optional<MapPicture> map;
        PreviewSink sink(inner, MapFrame(ground, map_size_on_page(ground, size)), format,
                         [&](MapPicture taken) {
                             EXPECT_FALSE(inner.finished);
                             map = std::move(taken);
                         });
        sink.relief().write({0, 0, 20, 20}, std::vector<float>(400, 5));
        sink.begin(layers, {});
        for (const auto& [index, feature] : features)
            sink.add(index, feature);
        RunReport report;
        report.buildings = 1;
        report.vertices = 4;
        sink.take_report(report);
        sink.finish();
        return std::move(map).value();
    }
    /// The colour at a place of the map.
    static Colour at(const MapPicture& map, double x, double y) {
        const Pixels pixels(map.frame.size(), [&](cairo_t* pen) { paint(map, pen, {0, 0}, 10); });
        const PixelPoint pixel = map.frame.pixel({x, y});
        return pixels.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
    }

    MemorySink inner;
    int size = 600;
};

TEST_F(PreviewTest, FeaturesGoOnAndAreDrawnWhereTheyLie) {
    const MapPicture map = picture({layer("buildings", "")}, {{0, square(5, 10, 5, 12)}});
    EXPECT_TRUE(inner.finished);
    ASSERT_EQ(inner.features.at(0).size(), 1U);
    EXPECT_EQ(map.legend, "Height of buildings");
    expect_near(at(map, 7.5, 12.5), seen(3));
    for (const auto& [x, y] : {std::pair{7.5, 15.5}, {7.5, 9.5}, {4.5, 12.5}, {10.5, 12.5}})
        EXPECT_EQ(at(map, x, y), level_ground);
}

TEST_F(PreviewTest, WhatIsNotCertainIsPaler) {
    LayerSpec buildings = layer("buildings", "");
    buildings.fields.push_back({"confidence", "", FieldType::real, "", ""});
    buildings.style.certainty = "confidence";
    buildings.style.certain = 0.9;
    const auto drawn = [&](FieldValue confidence) {
        Feature house = square(5, 10, 5, 12);
        house.values.push_back(std::move(confidence));
        return picture({buildings}, {{0, house}});
    };
    const MapPicture sure = drawn(0.9);
    expect_near(at(sure, 7.5, 12.5), seen(3));
    EXPECT_FALSE(sure.counts.paler);
    expect_near(at(drawn(FieldValue()), 7.5, 12.5), seen(3));  // nobody has asked
    const MapPicture unsure = drawn(0.5);
    EXPECT_TRUE(unsure.counts.paler);
    EXPECT_GT(at(unsure, 7.5, 12.5)[2], at(drawn(0.8), 7.5, 12.5)[2] + 20);
    EXPECT_GT(at(drawn(0.8), 7.5, 12.5)[2], seen(3)[2] + 20);
}

TEST_F(PreviewTest, BuildingsHaveColoursAndTheirPartsLines) {
    const MapPicture map =
        picture({layer("buildings", ""), layer("contours", "level")},
                {{0, square(5, 10, 6, 60)}, {1, square(5, 10, 6, 12)}, {1, square(6, 11, 2, 25)}});
    EXPECT_EQ(map.legend, "Height of buildings");
    expect_near(at(map, 7, 12), seen(7));
    expect_near(at(map, 10, 15), seen(7));
    EXPECT_LT(at(map, 8, 12)[0], seen(7)[0] - 20);  // the side of a part
}

TEST_F(PreviewTest, PartsAloneAreDrawnFromLowToHigh) {
    for (const writing::PictureFormat format : {writing::PictureFormat::png, writing::PictureFormat::svg}) {
        const MapPicture map = picture({layer("contours", "level")},
                                       {{0, square(5, 10, 6, 12)}, {0, square(6, 11, 2, 25)}}, format);
        EXPECT_EQ(map.legend, "Height of contours");
        expect_near(at(map, 10, 15), seen(3));
        expect_near(at(map, 7, 12), seen(5));  // hides what is below
    }
}

TEST_F(PreviewTest, CourtyardsStayOpen) {
    Feature house = square(2, 2, 12, 12);
    house.parts[0].interiors = {{{6, 6}, {6, 10}, {10, 10}, {10, 6}}};
    const MapPicture map = picture({layer("buildings", "")}, {{0, house}});
    EXPECT_EQ(at(map, 8, 8), level_ground);
    expect_near(at(map, 4, 8), seen(3));
}

TEST_F(PreviewTest, WhatHasNoHeightIsNotDrawn) {
    Feature root = square(0, 0, 20, 0);
    root.values[1] = FieldValue{};
    EXPECT_EQ(at(picture({layer("contours", "level")}, {{0, root}}), 7.5, 7.5), level_ground);
    // Nor what a layer without heights holds.
    LayerSpec doubtful = layer("doubtful", "");
    doubtful.style.colour = "";
    EXPECT_EQ(at(picture({layer("buildings", ""), doubtful}, {{1, square(5, 10, 5, 12)}}), 7.5, 12.5),
              level_ground);
}

TEST_F(PreviewTest, AMapIsAPageInEveryFormat) {
    for (const writing::PictureFormat format :
         {writing::PictureFormat::png, writing::PictureFormat::svg, writing::PictureFormat::pdf}) {
        const auto draw = [&] {
            return draw_map_page(picture({layer("buildings", "")}, {{0, square(5, 10, 5, 12)}}, format),
                                 "lod 4", format, size);
        };
        EXPECT_EQ(draw(), draw());
    }
}

TEST_F(PreviewTest, ThePageIsAsLongAsAskedFor) {
    for (const int longest : {300, 601, 1600}) {
        size = longest;
        const Pixels page(draw_map_page(picture({layer("buildings", "")}, {}), "lod 4",
                                        writing::PictureFormat::png, longest));
        EXPECT_EQ(std::max(page.width(), page.height()), longest);
    }
}

TEST(MapPage, FitsMapsOfAnyForm) {
    for (const auto& [rows, cols] : {std::pair{10, 10}, {10, 1000}, {1000, 10}, {3, 5}, {5, 3}, {1, 1}}) {
        const PixelSize map = map_size_on_page(field(rows, cols), 1000);
        EXPECT_GE(std::min(map.width, map.height), 1);
        EXPECT_LE(std::max(map.width, map.height), 1000);
        EXPECT_GT(std::max(map.width, map.height), 500);
        EXPECT_NEAR(static_cast<double>(map.width) / cols, static_cast<double>(map.height) / rows, 0.6);
    }
}

}  // namespace
}  // namespace d2b::view
