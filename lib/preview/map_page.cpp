#include "preview/map_page.hpp"

#include <algorithm>
#include <cmath>

#include "preview/footer.hpp"
#include "preview/page.hpp"
#include "preview/painted_map.hpp"

namespace d2b {
namespace {

constexpr int lines = 2;

double font_of(int longest) {
    constexpr double letters_a_side = 64;
    return std::max(longest / letters_a_side, 9.0);
}
double margin_of(double font) {
    return std::round(font * 0.8);
}

struct PageLayout {
    PixelSize page;
    PixelSize map;
    double font = 0;
};

/// Makes the map as wide as the page, or narrower if it would be too high.
PageLayout lay_out(const MapGround& ground, int longest) {
    const double font = font_of(longest);
    const double margin = margin_of(font);
    const double aspect = aspect_of(ground);
    const double least = Footer::least_width(font);
    double width = longest - 2 * margin;
    double footer = Footer(width, font, lines).height();
    const double around = 2.5 * margin;
    if (width / aspect + footer + around > longest) {
        // Two iterations, because the height of the footer depends on the width.
        for (int step = 0; step < 2; ++step) {
            width = std::max((longest - footer - around) * aspect, least);
            footer = Footer(width, font, lines).height();
        }
        width = std::min(width, longest - 2 * margin);
    }
    const double map_height = std::min(width / aspect, longest - footer - around);
    return {{whole_pixels(width + 2 * margin), whole_pixels(map_height + footer + around)},
            {whole_pixels(map_height * aspect), whole_pixels(map_height)},
            font};
}

std::string summary(const PictureCounts& counts, const std::string& tried) {
    std::string text = found(counts) + " · " + counted(counts.points, "point");
    if (counts.stacked)
        text += " · RMSE of the stack " + rounded_metres(counts.rmse_m);
    return text + " · " + tried + (counts.paler ? less_certain : "");
}

}  // namespace

PixelSize map_on_page(const MapGround& ground, int longest) {
    return lay_out(ground, longest).map;
}

std::string draw_map_page(const MapPicture& map, const std::string& tried, PictureFormat format,
                          int longest) {
    const MapGround& ground = map.frame.ground();
    const auto [page, size, font] = lay_out(ground, longest);
    const double margin = margin_of(font);
    const double width = page.width - 2 * margin;
    const Footer footer(width, font, lines);
    const FooterText text{map.legend, {summary(map.counts, tried), source_line(ground)}};
    return draw_page(page, format, [&, size = size, font = font](cairo_t* pen) {
        paint(map, pen, {std::round(margin + (width - size.width) / 2), margin}, font);
        footer.draw(pen, {margin, margin + size.height + margin * 0.75}, map.frame, text);
    });
}

}  // namespace d2b
