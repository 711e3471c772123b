#include "view/map_picture.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "view/field.hpp"
#include "view/map_page.hpp"
#include "view/page.hpp"
#include "view/pixels.hpp"

namespace d2b::view {
namespace {

using namespace test;

std::vector<TrialPicture> trials(const MapArea& ground, const SheetPlan& plan) {
    std::vector<TrialPicture> all;
    for (std::size_t i = 0; i < plan.trials; ++i) {
        const MapFrame frame(ground, map_size_on_sheet(ground, plan));
        MapPicture map{frame,
                       std::make_shared<Relief>(frame),
                       FootprintDrawing(frame, writing::PictureFormat::png),
                       "Height",
                       {}};
        const std::vector<float> level(
            static_cast<std::size_t>(ground.dem.rows) * static_cast<std::size_t>(ground.dem.cols), 5);
        map.relief->write(ground.dem.window, level);
        all.push_back({"lod " + std::to_string(i), std::move(map)});
    }
    return all;
}

TEST(ContactSheet, HasARowForWhatBelongsTogetherWhereThereIsRoom) {
    EXPECT_EQ(plan_sheet(9, 3, 1600).columns, 3);
    EXPECT_EQ(plan_sheet(8, 2, 1600).columns, 2);
    EXPECT_EQ(plan_sheet(8, 4, 1600).columns, 4);
    EXPECT_EQ(plan_sheet(6, 6, 1600).columns, 3);   // no room for six
    EXPECT_EQ(plan_sheet(16, 1, 1600).columns, 4);  // nor for sixteen below each other
    EXPECT_EQ(plan_sheet(12, 6, 2400).columns, 6);
    EXPECT_EQ(plan_sheet(1, 1, 200).columns, 1);
}

TEST(ContactSheet, IsAsLongAsAskedForAndItsMapsAreLegible) {
    for (const auto& [rows, cols] : {std::pair{30, 30}, {20, 60}, {60, 20}})
        for (const std::size_t count : {1U, 2U, 5U, 9U, 16U}) {
            const MapArea ground = field(rows, cols, Crs("EPSG:25833"));
            const SheetPlan plan = plan_sheet(count, 1, 1600);
            const Pixels sheet(draw_contact_sheet(trials(ground, plan), plan, writing::PictureFormat::png));
            EXPECT_EQ(std::max(sheet.width(), sheet.height()), 1600);
            const PixelSize map = map_size_on_sheet(ground, plan);
            EXPECT_GE(std::max(map.width, map.height), 240) << count << " of " << rows << " x " << cols;
            EXPECT_NEAR(static_cast<double>(map.width) / cols, static_cast<double>(map.height) / rows, 0.5);
        }
}

TEST(ContactSheet, HasACaptionAboveEachMap) {
    const MapArea ground = field(30, 30, Crs("EPSG:25833"));
    const SheetPlan plan = plan_sheet(5, 1, 1200);
    ASSERT_EQ(plan.columns, 3);
    const Pixels sheet(draw_contact_sheet(trials(ground, plan), plan, writing::PictureFormat::png));
    const PixelSize map = map_size_on_sheet(ground, plan);
    int maps = 0;
    for (int i = 0; i < 6; ++i) {
        const int left = 10 + i % 3 * (sheet.width() / 3);
        const int top = i / 3 * (map.height + 40);
        maps += sheet.dark(left, top, left + 200, top + 40) > 50 ? 1 : 0;
    }
    EXPECT_EQ(maps, 5);
    EXPECT_EQ(sheet.at(100, 300), level_ground);
}

MapFrame frame(const std::string& crs) {
    return {field(300, 300, Crs(crs)), {600, 600}};
}

TEST(ScaleBar, IsTheLongestRoundNumberThatFits) {
    EXPECT_EQ(scale_length(1).metres, 1);
    EXPECT_EQ(scale_length(1.99).metres, 1);
    EXPECT_EQ(scale_length(2).metres, 2);
    EXPECT_EQ(scale_length(49).metres, 20);
    EXPECT_EQ(scale_length(73).metres, 50);
    EXPECT_EQ(scale_length(73).parts, 5);
    EXPECT_EQ(scale_length(4999).metres, 2000);
    EXPECT_EQ(scale_length(0.6).metres, 0.5);
    EXPECT_EQ(length_text(200, true), "200 m");
    EXPECT_EQ(length_text(2000, true), "2 km");
    EXPECT_EQ(length_text(0.5, true), "0.5 m");
    EXPECT_EQ(length_text(2000, false), "2000 units");
}

TEST(ScaleBar, IsAsLongAsItSays) {
    // Half a metre a pixel: 200 pixels less room for the labels hold 50 m, which are 100 pixels.
    const Pixels bar({300, 60}, [](cairo_t* pen) { draw_scale_bar(pen, {20, 0}, 200, 20, 0.5, true); });
    const int row = 27 + 4;
    int first = 300;
    int last = 0;
    for (int x = 0; x < 300; ++x)
        if (bar.at(x, row)[0] < 128) {
            first = std::min(first, x);
            last = std::max(last, x);
        }
    EXPECT_NEAR(last - first, 100, 2);
    EXPECT_EQ(bar.at(first + 30, row), paper);  // the second of five parts
    EXPECT_LE(last, 220);
}

TEST(Footer, SetsTheScaleBelowTheLegendWhereThereIsNoRoomBeside) {
    const Footer wide(1000, 20, 2);
    const Footer narrow(Footer::min_width(20), 20, 2);
    EXPECT_GT(narrow.height(), wide.height() + 40);
    EXPECT_GT(Footer(1000, 20, 3).height(), wide.height() + 20);
}

TEST(Footer, ShowsNorthWhereItIsKnown) {
    const auto drawn = [](const std::string& crs) {
        return Pixels({1000, 150}, [&](cairo_t* pen) {
            Footer(1000, 20, 2).draw(pen, {0, 0}, frame(crs), {"Height", {"counts", "source"}});
        });
    };
    EXPECT_GT(drawn("EPSG:25833").dark(940, 0, 1000, 70), 50);
    EXPECT_EQ(drawn("").dark(960, 0, 1000, 20), 0);
    // Both lines of text, and none beyond the footer.
    const Pixels footer = drawn("EPSG:25833");
    const auto height = static_cast<int>(Footer(1000, 20, 2).height());
    EXPECT_GT(footer.dark(0, height - 50, 100, height - 27), 50);
    EXPECT_GT(footer.dark(0, height - 27, 100, height), 20);
    EXPECT_EQ(footer.dark(0, height, 1000, 150), 0);
}

TEST(MapPicture, NamesTheSourceAndCounts) {
    MapArea area = frame("EPSG:25833").area();
    area.dem.name = "/data/Łódź/dsm 1 m.tif";
    EXPECT_EQ(source_line(area), "Source: \u2068dsm 1 m.tif\u2069 · ETRS89 / UTM zone 33N");
    area.crs = Crs();
    EXPECT_EQ(source_line(area), "Source: \u2068dsm 1 m.tif\u2069 · CRS not known");
    EXPECT_EQ(count_noun(1, "building"), "1 building");
    EXPECT_EQ(count_noun(0, "building"), "0 buildings");
    EXPECT_EQ(count_noun(999, "point"), "999 points");
    EXPECT_EQ(count_noun(1234567, "point"), "1,234,567 points");
    EXPECT_EQ(count_text({.number = 2}), "2 buildings");
    EXPECT_EQ(count_text({.number = 2, .contours_only = true}), "2 contours");
    EXPECT_EQ(rounded_metres(0.849), "0.8 m");
    EXPECT_EQ(rounded_metres(0.96), "1.0 m");
    EXPECT_EQ(rounded_metres(12.34), "12.3 m");
}

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Pixels painted(const MapArea& ground, PixelSize size, const std::vector<float>& z) {
    Relief relief(MapFrame(ground, size));
    // Adds two pieces, as bands come.
    const std::int32_t first = ground.dem.rows / 3;
    const auto cells = static_cast<std::size_t>(first * ground.dem.cols);
    relief.write({0, 0, first, ground.dem.cols}, std::span(z).first(cells));
    relief.write({first, 0, ground.dem.rows - first, ground.dem.cols}, std::span(z).subspan(cells));
    return {size, [&](cairo_t* pen) { paint(relief, pen); }};
}

/// 20 x 20 cells, level but for a slope to the south in the last rows; two cells are no elevations.
std::vector<float> slope() {
    std::vector<float> z(400, 5);
    z[0] = z[1] = nan;
    for (std::size_t i = 300; i < 400; ++i)
        z[i] = 5 - static_cast<float>(i / 20 - 14);
    return z;
}

TEST(Relief, LevelGroundIsGreyAndSlopesAreShaded) {
    const Pixels map = painted(field(20, 20, {}, {0, 1, 0, 20, 0, -1}), {200, 200}, slope());
    EXPECT_EQ(map.at(75, 75), level_ground);
    EXPECT_EQ(map.at(75, 3), level_ground);
    EXPECT_EQ(map.at(8, 3), paper);  // no elevation, nor does it shade cells beside it
    EXPECT_EQ(map.at(35, 5), level_ground);
    EXPECT_LT(map.at(75, 175)[0], level_ground[0] - 20);  // away from the light
    EXPECT_EQ(map.at(199, 199), map.at(0, 199));          // to the edge
}

TEST(Relief, IsLitFromTheUpperLeftWhicheverWayRowsAndColumnsRun) {
    const std::vector<float> z = slope();
    const Pixels expected = painted(field(20, 20, {}, {0, 1, 0, 20, 0, -1}), {200, 200}, z);
    const auto expect_same = [&](const std::vector<float>& other, const AffineTransform& transform) {
        const Pixels map = painted(field(20, 20, {}, transform), {200, 200}, other);
        for (int y = 0; y < 200; y += 3)
            for (int x = 0; x < 200; x += 3)
                expect_near(map.at(x, y), expected.at(x, y), 1);
    };
    std::vector<float> mirrored = z;
    for (auto row = mirrored.begin(); row != mirrored.end(); row += 20)
        std::reverse(row, row + 20);
    expect_same(mirrored, {20, -1, 0, 20, 0, -1});
    expect_same({mirrored.rbegin(), mirrored.rend()}, {0, 1, 0, 0, 0, 1});  // rows from below
    expect_same({z.rbegin(), z.rend()}, {20, -1, 0, 0, 0, 1});
}

TEST(Relief, WhatIsSmallerThanAPixelIsAveraged) {
    // Roofs and gaps by turns, four cells a pixel: none of them is seen, and all of it is level.
    std::vector<float> z(400 * 400);
    for (std::size_t i = 0; i < z.size(); ++i)
        z[i] = (i % 400 + i / 400) % 2 == 0 ? 10.0F : 0.0F;
    z[0] = nan;  // three of its neighbours are known
    const Pixels map = painted(field(400, 400, {}, {0, 1, 0, 400, 0, -1}), {100, 100}, z);
    EXPECT_EQ(map.at(50, 50), level_ground);
    EXPECT_NE(map.at(0, 0), paper);
}

}  // namespace
}  // namespace d2b::view
