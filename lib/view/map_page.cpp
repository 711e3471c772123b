#include "view/map_page.hpp"

#include <algorithm>
#include <cmath>

#include "options/option_values.hpp"
#include "view/page.hpp"

namespace d2b::view {
namespace {

constexpr int lines = 2;

double font_of(int longest) {
    constexpr double letters_per_side = 64;
    return std::max(longest / letters_per_side, 9.0);
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
PageLayout lay_out_page(const MapArea& area, int longest) {
    const double font = font_of(longest);
    const double margin = margin_of(font);
    const double aspect = aspect_ratio(area);
    const double least = Footer::min_width(font);
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
    return {{round_to_pixels(width + 2 * margin), round_to_pixels(map_height + footer + around)},
            {round_to_pixels(map_height * aspect), round_to_pixels(map_height)},
            font};
}

std::string summary(const PictureCounts& counts, const std::string& parameters) {
    std::string text = count_text(counts) + " · " + count_noun(counts.points, "point");
    if (counts.stacked)
        text += " · RMSE of the stack " + rounded_metres(counts.rmse_m);
    return text + " · " + parameters + (counts.paler ? uncertain_note : "");
}

}  // namespace

PixelSize map_size_on_page(const MapArea& area, int longest) {
    return lay_out_page(area, longest).map;
}

std::string draw_map_page(const MapPicture& map, const std::string& parameters, writing::PictureFormat format,
                          int longest) {
    const MapArea& area = map.frame.area();
    const auto [page, size, font] = lay_out_page(area, longest);
    const double margin = margin_of(font);
    const double width = page.width - 2 * margin;
    const Footer footer(width, font, lines);
    const FooterText text{map.legend, {summary(map.counts, parameters), source_line(area)}};
    return draw_page(page, format, [&, size = size, font = font](cairo_t* pen) {
        paint(map, pen, {std::round(margin + (width - size.width) / 2), margin}, font);
        footer.draw(pen, {margin, margin + size.height + margin * 0.75}, map.frame, text);
    });
}

namespace {

constexpr double caption_letters = 17;  ///< width of a caption, in font sizes
constexpr double caption_height = 3.3;  ///< including the space above it

/// Layout in pixels.
struct SheetLayout {
    PixelSize page;
    PixelSize map;
    double font = 0;
    double gap = 0;
    double cell_width = 0;
    double cell_height = 0;
};

SheetLayout lay_out_sheet(const MapArea& area, const SheetPlan& plan) {
    constexpr double letters_per_cell = 22;
    constexpr double letters_per_side = 64;
    const double longest = plan.longest;
    const int columns = plan.columns;
    const int rows = (static_cast<int>(plan.trials) + columns - 1) / columns;
    SheetLayout sheet;
    sheet.font = std::min(longest / columns / letters_per_cell, longest / letters_per_side);
    sheet.gap = std::round(sheet.font);
    const double aspect = aspect_ratio(area);
    const double caption = caption_height * sheet.font;
    double width = (longest - sheet.gap) / columns - sheet.gap;
    double height = width / aspect;
    const double least = std::max(caption_letters * sheet.font,
                                  (Footer::min_width(sheet.font) + sheet.gap) / columns - sheet.gap);
    const auto across = [&] { return columns * (std::max(width, least) + sheet.gap) - sheet.gap; };
    const auto footer = [&] { return Footer(across(), sheet.font, 1).height() + 2 * sheet.gap; };
    const bool too_high = rows * (height + caption) + footer() > longest;
    // Two iterations, because the height of the footer depends on the width.
    for (int step = 0; too_high && step < 2; ++step) {
        height = std::max((longest - footer()) / rows - caption, 1.0);
        width = height * aspect;
    }
    // Rounded down, because the errors of many maps would add up.
    sheet.map = {round_to_pixels(std::floor(width)), round_to_pixels(std::floor(height))};
    sheet.cell_width = std::max<double>(sheet.map.width, std::floor(least));
    sheet.cell_height = std::floor(caption) + sheet.map.height;
    sheet.page = too_high ? PixelSize{round_to_pixels(across() + 2 * sheet.gap), plan.longest}
                          : PixelSize{plan.longest, round_to_pixels(rows * sheet.cell_height + footer())};
    return sheet;
}

std::string short_summary(const PictureCounts& counts) {
    std::string text = count_text(counts);
    if (counts.stacked)
        text += ", RMSE " + rounded_metres(counts.rmse_m);
    return text;
}

void draw_trial(cairo_t* pen, const TrialPicture& trial, const SheetLayout& sheet, PixelPoint place) {
    const double top = place.y + sheet.font * 0.6;
    draw_text(pen, {place.x, top}, {.size = sheet.font, .bold = true, .max_width = sheet.cell_width},
              trial.caption);
    draw_text(pen, {place.x, top + line_spacing * sheet.font},
              {.size = sheet.font * 0.9, .max_width = sheet.cell_width}, short_summary(trial.map.counts));
    paint(trial.map, pen, {place.x, place.y + sheet.cell_height - sheet.map.height}, sheet.font);
}

}  // namespace

SheetPlan plan_sheet(std::size_t trials, std::size_t across, int longest) {
    const auto most = static_cast<std::size_t>(std::max(longest / min_trial_px, 1));
    std::size_t columns = 1;
    while (columns * columns < trials)
        ++columns;
    if (across > 1 && across <= most && (trials + across - 1) / across <= most)
        columns = across;
    return {trials, static_cast<int>(columns), longest};
}

PixelSize map_size_on_sheet(const MapArea& area, const SheetPlan& plan) {
    return lay_out_sheet(area, plan).map;
}

std::string draw_contact_sheet(std::span<const TrialPicture> trials, const SheetPlan& plan,
                               writing::PictureFormat format) {
    const MapPicture& first = trials.front().map;
    const SheetLayout sheet = lay_out_sheet(first.frame.area(), plan);
    const double width = sheet.page.width - 2 * sheet.gap;
    const Footer footer(width, sheet.font, 1);
    const bool paler =
        std::ranges::any_of(trials, [](const TrialPicture& trial) { return trial.map.counts.paler; });
    return draw_page(sheet.page, format, [&](cairo_t* pen) {
        for (std::size_t i = 0; i < trials.size(); ++i) {
            const auto columns = static_cast<std::size_t>(plan.columns);
            const std::size_t row = i / columns;
            const std::size_t col = i % columns;
            draw_trial(pen, trials[i], sheet,
                       {sheet.gap + static_cast<double>(col) * (sheet.cell_width + sheet.gap),
                        static_cast<double>(row) * sheet.cell_height});
        }
        footer.draw(pen, {sheet.gap, sheet.page.height - footer.height() - sheet.gap * 0.25}, first.frame,
                    {first.legend, {source_line(first.frame.area()) + (paler ? uncertain_note : "")}});
    });
}

}  // namespace d2b::view
