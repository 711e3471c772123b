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
        PreviewSink sink(inner, MapFrame(ground, plan_page(ground, size).map), format, [&](MapPicture taken) {
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

TEST(Preview, LeavesRoundingToTheFile) {
    class WholeMetres final : public MemorySink {
        [[nodiscard]] CoordinateRounding rounding() const override {
            return {CoordinateRounding::To::decimals, 0, "-lco COORDINATE_PRECISION=0"};
        }
    };
    WholeMetres file;
    const MapFrame frame(field(20, 20, {}, {0, 1, 0, 20, 0, -1}), {20, 20});
    const PreviewSink sink(file, frame, writing::PictureFormat::png, {});
    EXPECT_EQ(sink.rounding().to, CoordinateRounding::To::decimals);
    EXPECT_EQ(sink.rounding().cause, "-lco COORDINATE_PRECISION=0");
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
        expect_near(at(map, 7, 12), seen(5));  // hides the one below
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
    // Nor the features of a layer without heights.
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
                                 format, plan_page(field(20, 20), size));
        };
        EXPECT_EQ(draw(), draw());
    }
}

TEST_F(PreviewTest, ThePageIsAsLongAsAskedFor) {
    for (const int longest : {300, 601, 1600}) {
        size = longest;
        const Pixels page(draw_map_page(picture({layer("buildings", "")}, {}), writing::PictureFormat::png,
                                        plan_page(field(20, 20), longest)));
        EXPECT_EQ(std::max(page.width(), page.height()), longest);
    }
}

TEST(MapPage, FitsMapsOfAnyForm) {
    for (const auto& [rows, cols] : {std::pair{10, 10}, {10, 1000}, {1000, 10}, {3, 5}, {5, 3}, {1, 1}}) {
        const PixelSize map = plan_page(field(rows, cols), 1000).map;
        EXPECT_GE(std::min(map.width, map.height), 1);
        EXPECT_LE(std::max(map.width, map.height), 1000);
        EXPECT_GT(std::max(map.width, map.height), 500);
        EXPECT_NEAR(static_cast<double>(map.width) / cols, static_cast<double>(map.height) / rows, 0.6);
    }
}

std::string refusal_of_paper(const MapArea& area, const PaperRequest& request) {
    try {
        static_cast<void>(plan_paper(area, request, writing::PictureFormat::pdf));
        return "";
    } catch (const OptionError& error) {
        return error.what();
    }
}

TEST(Paper, HasTheSizeOfIso216) {
    const MapArea area = field(10, 10, Crs("EPSG:25833"));
    constexpr double vector_px = 96 / 25.4;
    constexpr double png_px = 150 / 25.4;
    const std::vector<std::pair<int, int>> sides{{841, 1189}, {594, 841}, {420, 594},
                                                 {297, 420},  {210, 297}, {148, 210}};
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const auto& [shorter, longer] = sides[i];
        const auto paper = static_cast<Paper>(i);
        const PageLayout pdf = plan_paper(area, {paper, false, {}}, writing::PictureFormat::pdf);
        EXPECT_NEAR(pdf.page.width, shorter * vector_px, 0.5);
        EXPECT_NEAR(pdf.page.height, longer * vector_px, 0.5);
        const PageLayout png = plan_paper(area, {paper, true, {}}, writing::PictureFormat::png);
        EXPECT_NEAR(png.page.width, longer * png_px, 0.5);
        EXPECT_NEAR(png.page.height, shorter * png_px, 0.5);
    }
}

/// 150 m at 1:1000 are 15 cm.
TEST(Paper, HasTheMapAtItsScale) {
    const MapArea area = field(100, 150, Crs("EPSG:25833"));
    const PageLayout a4 = plan_paper(area, {Paper::a4, false, 1000}, writing::PictureFormat::svg);
    EXPECT_NEAR(a4.map.width, 150 * 96 / 25.4, 0.5);
    EXPECT_NEAR(a4.map.height, 100 * 96 / 25.4, 0.5);
    EXPECT_EQ(a4.scale, "1:1,000 on A4");
    const PageLayout large = plan_paper(area, {Paper::a0, true, 312.5}, writing::PictureFormat::png);
    EXPECT_NEAR(large.map.width, 150 / 0.3125 * 150 / 25.4, 0.5);
    EXPECT_EQ(large.scale, "1:312.5 on A0");
}

/// A4 leaves 19 cm of its width: 150 m fit at 1:790 and more.
TEST(Paper, HasTheLargestRoundScaleByDefault) {
    const MapArea area = field(100, 150, Crs("EPSG:25833"));
    EXPECT_EQ(plan_paper(area, {Paper::a4, false, {}}, writing::PictureFormat::svg).scale, "1:1,000 on A4");
    EXPECT_EQ(
        plan_paper(field(10, 141, Crs("EPSG:25833")), {Paper::a4, false, {}}, writing::PictureFormat::svg)
            .scale,
        "1:750 on A4");
    EXPECT_EQ(
        plan_paper(field(10, 21000, Crs("EPSG:25833")), {Paper::a4, false, {}}, writing::PictureFormat::svg)
            .scale,
        "1:150,000 on A4");
}

TEST(Paper, IsRefusedWithTheScaleThatFits) {
    const MapArea wide = field(100, 230, Crs("EPSG:25833"));
    EXPECT_EQ(refusal_of_paper(wide, {Paper::a4, false, 1000}),
              "The area does not fit on A4 at 1:1,000; turn the paper (-landscape), or use -preview_scale "
              "1500, a larger -preview_paper or a part of the input (-te).");
    EXPECT_EQ(refusal_of_paper(wide, {Paper::a4, false, 1500}), "");
    EXPECT_EQ(refusal_of_paper(wide, {Paper::a4, true, 1000}), "");
    EXPECT_EQ(
        refusal_of_paper(field(2000, 2000, Crs("EPSG:25833")), {Paper::a3, true, 1000}),
        "The area does not fit on A3 at 1:1,000; use -preview_scale 10000, a larger -preview_paper or a "
        "part of the input (-te).");
}

TEST(Paper, HasNoScaleWithoutAUnit) {
    const MapArea area = field(100, 150);
    EXPECT_EQ(refusal_of_paper(area, {Paper::a4, false, 1000}),
              "-preview_scale needs a CRS with a known unit; name it with -a_srs.");
    const PageLayout page = plan_paper(area, {Paper::a4, false, {}}, writing::PictureFormat::svg);
    EXPECT_EQ(page.scale, "");
    EXPECT_NEAR(page.map.width, 190 * 96 / 25.4, 0.6);
}

TEST(FirstOutlines, TellWhichAreNewAndWhichAreMissing) {
    const FirstOutlines::Rings one{{{0, 0}, {1, 0}, {1, 1}}};
    const FirstOutlines::Rings two{{{5, 5}, {6, 5}, {6, 6}}};
    FirstOutlines first;
    first.add(0, one);
    first.add(1, two);
    first.complete();
    EXPECT_TRUE(first.find(0, one));
    EXPECT_FALSE(first.find(0, two));  // of another layer
    const std::vector<FirstOutlines::Outline> missing = first.take_missing();
    ASSERT_EQ(missing.size(), 1U);
    EXPECT_EQ(missing[0].layer, 1U);
    EXPECT_EQ(missing[0].rings[0][0].x, 5);
    EXPECT_EQ(first.take_missing().size(), 2U);  // nothing is seen on the next map
}

TEST_F(PreviewTest, DifferencesFromTheFirstMapAreBlue) {
    const auto first = std::make_shared<FirstOutlines>();
    const MapArea ground = field(20, 20, {}, {0, 1, 0, 20, 0, -1});
    const auto draw = [&](const Feature& feature) {
        std::optional<MapPicture> map;
        PreviewSink sink(
            inner, MapFrame(ground, plan_page(ground, size).map), writing::PictureFormat::png,
            [&](MapPicture taken) { map = std::move(taken); }, first);
        const std::vector<LayerSpec> layers{layer("buildings", ""), layer("contours", "")};
        sink.relief().write({0, 0, 20, 20}, std::vector<float>(400, 5));
        sink.begin(layers, {});
        sink.add(0, feature);
        sink.add(1, feature);
        sink.finish();
        return std::move(map).value();
    };
    const auto is_blue = [&](const MapPicture& map, double x, double y) {
        const Colour colour = at(map, x, y);
        return colour[2] > colour[0] + 60;
    };
    const MapPicture before = draw(square(5, 10, 5, 12));
    EXPECT_FALSE(is_blue(before, 5, 12.5));
    const MapPicture same = draw(square(5, 10, 5, 12));
    EXPECT_EQ(same.counts.added + same.counts.missing, 0);
    EXPECT_FALSE(is_blue(same, 5, 12.5));
    const MapPicture moved = draw(square(12, 10, 5, 12));
    EXPECT_EQ(moved.counts.added, 1);  // the contour is not counted again
    EXPECT_EQ(moved.counts.missing, 1);
    EXPECT_TRUE(is_blue(moved, 12, 12.5));
}

}  // namespace
}  // namespace d2b::view
