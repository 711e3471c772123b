#include "preview/contact_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "options/sweep_plan.hpp"
#include "preview/footer.hpp"
#include "preview/page.hpp"
#include "preview/page_text.hpp"
#include "preview/painted_map.hpp"

namespace d2b {
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

SheetLayout lay_out(const MapGround& ground, const SheetPlan& plan) {
    constexpr double letters_a_cell = 22;
    constexpr double letters_a_side = 64;
    const double longest = plan.longest;
    const int columns = plan.columns;
    const int rows = (static_cast<int>(plan.trials) + columns - 1) / columns;
    SheetLayout sheet;
    sheet.font = std::min(longest / columns / letters_a_cell, longest / letters_a_side);
    sheet.gap = std::round(sheet.font);
    const double aspect = aspect_of(ground);
    const double caption = caption_height * sheet.font;
    double width = (longest - sheet.gap) / columns - sheet.gap;
    double height = width / aspect;
    const double least = std::max(caption_letters * sheet.font,
                                  (Footer::least_width(sheet.font) + sheet.gap) / columns - sheet.gap);
    const auto across = [&] { return columns * (std::max(width, least) + sheet.gap) - sheet.gap; };
    const auto footer = [&] { return Footer(across(), sheet.font, 1).height() + 2 * sheet.gap; };
    const bool too_high = rows * (height + caption) + footer() > longest;
    // Two iterations, because the height of the footer depends on the width.
    for (int step = 0; too_high && step < 2; ++step) {
        height = std::max((longest - footer()) / rows - caption, 1.0);
        width = height * aspect;
    }
    // Rounded down, because the errors of many maps would add up.
    sheet.map = {whole_pixels(std::floor(width)), whole_pixels(std::floor(height))};
    sheet.cell_width = std::max<double>(sheet.map.width, std::floor(least));
    sheet.cell_height = std::floor(caption) + sheet.map.height;
    sheet.page = too_high ? PixelSize{whole_pixels(across() + 2 * sheet.gap), plan.longest}
                          : PixelSize{plan.longest, whole_pixels(rows * sheet.cell_height + footer())};
    return sheet;
}

std::string short_summary(const PictureCounts& counts) {
    std::string text = found(counts);
    if (counts.stacked)
        text += ", RMSE " + rounded_metres(counts.rmse_m);
    return text;
}

void draw_trial(cairo_t* pen, const TrialPicture& trial, const SheetLayout& sheet, Spot place) {
    const double top = place.y + sheet.font * 0.6;
    draw_text(pen, {place.x, top}, {.size = sheet.font, .bold = true, .room = sheet.cell_width},
              trial.caption);
    draw_text(pen, {place.x, top + line_spacing * sheet.font},
              {.size = sheet.font * 0.9, .room = sheet.cell_width}, short_summary(trial.map.counts));
    paint(trial.map, pen, {place.x, place.y + sheet.cell_height - sheet.map.height}, sheet.font);
}

}  // namespace

SheetPlan plan_sheet(std::size_t trials, std::size_t across, int longest) {
    const auto most = static_cast<std::size_t>(std::max(longest / legible_trial_px, 1));
    std::size_t columns = 1;
    while (columns * columns < trials)
        ++columns;
    if (across > 1 && across <= most && (trials + across - 1) / across <= most)
        columns = across;
    return {trials, static_cast<int>(columns), longest};
}

PixelSize map_on_sheet(const MapGround& ground, const SheetPlan& plan) {
    return lay_out(ground, plan).map;
}

std::string draw_contact_sheet(std::span<const TrialPicture> trials, const SheetPlan& plan,
                               PictureFormat format) {
    const MapPicture& first = trials.front().map;
    const SheetLayout sheet = lay_out(first.frame.ground(), plan);
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
                    {first.legend, {source_line(first.frame.ground()) + (paler ? less_certain : "")}});
    });
}

}  // namespace d2b
