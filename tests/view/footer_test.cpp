#include "view/field.hpp"
#include "view/map_picture.hpp"
#include "view/page.hpp"
#include "view/pixels.hpp"

namespace d2b::test {
namespace {

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

}  // namespace
}  // namespace d2b::test
