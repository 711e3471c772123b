#include "view/page.hpp"

#include <regex>

#include "view/pixels.hpp"

namespace d2b::view {
namespace {

using namespace test;

/// All that pages are made of: an image, shapes of another surface, text. Drawings of other surfaces
/// outlive the page, as maps do.
class All {
  public:
    All() {
        const CairoPtr pen(cairo_create(shapes_.get()));
        cairo_rectangle(pen.get(), 10, 10, 50, 50);
        cairo_fill(pen.get());
    }
    [[nodiscard]] std::string page(writing::PictureFormat format, PixelSize size = {100, 80}) const {
        return draw_page(size, format, [&](cairo_t* pen) {
            cairo_set_source_surface(pen, image_.get(), 0, 0);
            cairo_paint(pen);
            cairo_set_source_surface(pen, shapes_.get(), 0, 0);
            cairo_paint_with_alpha(pen, 0.5);
            draw_text(pen, {5, 60}, {.size = 12}, "Straße");
        });
    }

  private:
    cairo_rectangle_t extents_{0, 0, 100, 80};
    SurfacePtr image_{cairo_image_surface_create(CAIRO_FORMAT_ARGB32, 4, 4)};
    SurfacePtr shapes_{cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extents_)};
};

TEST(PictureFormat, IsThatOfTheExtension) {
    EXPECT_EQ(writing::picture_format_of("a/map.png"), writing::PictureFormat::png);
    EXPECT_EQ(writing::picture_format_of("MAP.SVG"), writing::PictureFormat::svg);
    EXPECT_EQ(writing::picture_format_of("map.v2.pdf"), writing::PictureFormat::pdf);
    EXPECT_FALSE(writing::picture_format_of("map.jpg"));
    EXPECT_FALSE(writing::picture_format_of("png"));
    EXPECT_FALSE(writing::begins_a_picture("GIF89a"));
    EXPECT_FALSE(writing::begins_a_picture(""));
}

TEST(Page, HasTheFormatTheSizeAndTheSameBytesTwice) {
    for (const writing::PictureFormat format :
         {writing::PictureFormat::png, writing::PictureFormat::svg, writing::PictureFormat::pdf}) {
        const std::string page = All().page(format);
        EXPECT_TRUE(writing::begins_a_picture(page.substr(0, 1024)));
        EXPECT_EQ(All().page(format), page);
    }
    const Pixels png(All().page(writing::PictureFormat::png));
    EXPECT_EQ(png.width(), 100);
    EXPECT_EQ(png.height(), 80);
    EXPECT_EQ(png.at(99, 0), paper);
    expect_near(png.at(30, 30), {128, 128, 128});
    const std::string svg = All().page(writing::PictureFormat::svg);
    EXPECT_NE(svg.find("width=\"100px\" height=\"80px\""), std::string::npos);
    const std::string pdf = All().page(writing::PictureFormat::pdf);
    // Cairo 1.18 compresses the objects that hold the size of a page.
    const bool is_compressed = pdf.find("/ObjStm") != std::string::npos;
    EXPECT_NE(is_compressed, std::regex_search(pdf, std::regex(R"(MediaBox \[ 0 0 75 60 \])")));
    EXPECT_EQ(pdf.find("Date"), std::string::npos);
}

/// Each number that is referred to is that of one thing.
TEST(Page, NumbersOfAnSvgAgree) {
    const std::string svg = All().page(writing::PictureFormat::svg);
    const std::regex used("[(\"]#([a-z0-9-]+)");
    int count = 0;
    for (std::sregex_iterator at(svg.begin(), svg.end(), used), end; at != end; ++at, ++count) {
        const std::string id = "id=\"" + (*at)[1].str() + "\"";
        const std::size_t first = svg.find(id);
        EXPECT_NE(first, std::string::npos) << id;
        EXPECT_EQ(svg.find(id, first + 1), std::string::npos) << id;
    }
    EXPECT_GT(count, 2);
}

TEST(Page, TooLargeForCairoIsAnOutputError) {
    EXPECT_THROW(static_cast<void>(All().page(writing::PictureFormat::png, {100000, 100000})), OutputError);
}

TEST(PageText, AnyScriptIsDrawnAndBytesThatAreNoneToo) {
    for (const char* text : {"Łódź", "Αθήνα", "القاهرة", "תל אביב", "東京", "\xff\xfe", "a\nb", ""}) {
        const Pixels line({300, 40}, [&](cairo_t* pen) { draw_text(pen, {5, 5}, {.size = 20}, text); });
        EXPECT_EQ(line.dark(0, 0, 300, 40) > 20, *text != '\0') << text;
    }
}

TEST(PageText, KeepsToItsRoomAndItsPlace) {
    const std::string text(200, 'm');
    const Pixels line({300, 40}, [&](cairo_t* pen) {
        draw_text(pen, {10, 5}, {.size = 20, .max_width = 200}, text);
    });
    EXPECT_GT(line.dark(150, 0, 210, 40), 50);
    EXPECT_EQ(line.dark(211, 0, 300, 40), 0);
    const Pixels right({300, 40}, [&](cairo_t* pen) {
        draw_text(pen, {290, 5}, {.size = 20, .align = Align::right}, "MM");
    });
    EXPECT_EQ(right.dark(291, 0, 300, 40), 0);
    EXPECT_GT(right.dark(250, 0, 291, 40), 50);
    EXPECT_EQ(right.dark(0, 0, 240, 40), 0);
}

}  // namespace
}  // namespace d2b::view
