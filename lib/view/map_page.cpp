#include "view/map_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "options/option_values.hpp"
#include "view/page.hpp"

namespace d2b::view {
namespace {

double font_of(int longest) {
    constexpr double letters_per_side = 64;
    return std::max(longest / letters_per_side, 9.0);
}
double margin_of(double font) {
    return std::round(font * 0.8);
}

constexpr double title_size = 1.6;  ///< in font sizes
constexpr double gap_below = 0.75;  ///< below the map and the title, in font sizes

/// Returns the height of the title with the gap below it.
double title_height(const PageWords& words, double font) {
    return words.title.empty() ? 0 : (title_size * line_spacing + gap_below) * font;
}

/// Returns the number of lines in the footer.
int line_count(const PageWords& words) {
    return words.credit.empty() ? 2 : 3;
}

std::string summary(const PictureCounts& counts, const PageLayout& layout) {
    return count_text(counts) + (counts.paler ? uncertain_note : "") +
           (layout.scale.empty() ? "" : " · Scale " + layout.scale);
}

constexpr double mm_per_inch = 25.4;

/// Short and long side in millimetres (ISO 216).
struct PaperSides {
    const char* name;
    double shorter;
    double longer;
};
constexpr std::array<PaperSides, 6> papers{{{"A0", 841, 1189},
                                            {"A1", 594, 841},
                                            {"A2", 420, 594},
                                            {"A3", 297, 420},
                                            {"A4", 210, 297},
                                            {"A5", 148, 210}}};

/// Returns the smallest round denominator of a scale that is at least this.
double round_scale(double least) {
    const double power = std::pow(10, std::floor(std::log10(least)));
    for (const double step : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 7.5})
        if (step * power >= least)
            return step * power;
    return 10 * power;
}

std::string scale_text(double denominator) {
    const bool whole = denominator == std::floor(denominator);
    return "1:" + (whole ? grouped(static_cast<std::int64_t>(denominator)) : number_text(denominator));
}

/// Page and the part of it that is free for the map, in pixels.
struct PaperRoom {
    PageLayout layout;
    double pixels_per_mm = 1;
    double width = 0;
    double height = 0;

    /// Returns the smallest denominator at which the area fits.
    [[nodiscard]] double least_scale(const MapArea& area) const {
        constexpr double mm_per_metre = 1000;
        const double across = area.cell.across * area.dem.window.cols * mm_per_metre * pixels_per_mm;
        const double down = area.cell.down * area.dem.window.rows * mm_per_metre * pixels_per_mm;
        return std::max(across / width, down / height);
    }
};

PaperRoom room_on(const PaperSides& sides, bool landscape, writing::PictureFormat format,
                  const PageWords& words) {
    constexpr double pixels_per_inch_png = 150;
    constexpr double pixels_per_inch = 96;  // of SVG, and of our PDF
    constexpr double margin_mm = 10;
    PaperRoom room;
    room.pixels_per_mm =
        (format == writing::PictureFormat::png ? pixels_per_inch_png : pixels_per_inch) / mm_per_inch;
    const double width = landscape ? sides.longer : sides.shorter;
    const double height = landscape ? sides.shorter : sides.longer;
    PageLayout& layout = room.layout;
    layout.on_paper = true;
    layout.page = {round_to_pixels(width * room.pixels_per_mm), round_to_pixels(height * room.pixels_per_mm)};
    // Three millimetres on A4; letters grow less than the paper, because a poster is read from nearby as
    // well.
    layout.font = 3 * std::sqrt(sides.shorter / papers[4].shorter) * room.pixels_per_mm;
    layout.margin = margin_mm * room.pixels_per_mm;
    room.width = layout.page.width - 2 * layout.margin;
    room.height = layout.page.height - 2 * layout.margin - title_height(words, layout.font) -
                  gap_below * layout.font - Footer(room.width, layout.font, line_count(words)).height();
    return room;
}

[[noreturn]] void refuse_scale(double scale, const PaperSides& sides, double fits, double fits_turned) {
    const std::string turned = fits_turned <= scale ? "; turn the paper (-landscape), or use " : "; use ";
    throw OptionError("The area does not fit on " + std::string(sides.name) + " at " + scale_text(scale) +
                      turned + "-preview_scale " + number_text(round_scale(fits)) +
                      ", a larger -preview_paper or a part of the input (-te).");
}

/// @param place middle of the top
void draw_title(cairo_t* pen, PixelPoint place, double font, double max_width, const std::string& title) {
    if (!title.empty())
        draw_text(pen, place,
                  {.size = font * title_size, .bold = true, .align = Align::middle, .max_width = max_width},
                  title);
}

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
    const double head = title_height(plan.words, sheet.font);
    const int footer_lines = 1 + (plan.words.credit.empty() ? 0 : 1) + (plan.trials > 1 ? 1 : 0);
    const auto footer = [&] {
        return Footer(across(), sheet.font, footer_lines).height() + 2 * sheet.gap + head;
    };
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
    if (counts.stacked && counts.added + counts.missing == 0)
        text += ", RMSE " + rounded_metres(counts.rmse_m);
    if (counts.added > 0)
        text += ", " + grouped(counts.added) + " new";
    if (counts.missing > 0)
        text += ", " + grouped(counts.missing) + " gone";
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

PageWords page_words(const Options& options) {
    return {options.write.title, options.write.credit};
}

/// Makes the map as wide as the page, or narrower if it would be too high.
PageLayout plan_page(const MapArea& area, int longest, const PageWords& words) {
    const double font = font_of(longest);
    const double margin = margin_of(font);
    const double aspect = aspect_ratio(area);
    const double least = Footer::min_width(font);
    double width = longest - 2 * margin;
    double footer = Footer(width, font, line_count(words)).height();
    const double around = 2.5 * margin + title_height(words, font);
    if (width / aspect + footer + around > longest) {
        // Two iterations, because the height of the footer depends on the width.
        for (int step = 0; step < 2; ++step) {
            width = std::max((longest - footer - around) * aspect, least);
            footer = Footer(width, font, line_count(words)).height();
        }
        width = std::min(width, longest - 2 * margin);
    }
    const double map_height = std::min(width / aspect, longest - footer - around);
    return {{round_to_pixels(width + 2 * margin), round_to_pixels(map_height + footer + around)},
            {round_to_pixels(map_height * aspect), round_to_pixels(map_height)},
            font,
            margin};
}

PageLayout plan_paper(const MapArea& area, const PaperRequest& request, writing::PictureFormat format,
                      const PageWords& words) {
    const PaperSides& sides = papers[static_cast<std::size_t>(request.paper)];
    PaperRoom room = room_on(sides, request.landscape, format, words);
    const double least = room.least_scale(area);
    double scale = least;
    if (in_metres(area.crs)) {
        scale = request.scale.value_or(round_scale(least));
        room.layout.scale = scale_text(scale) + " on " + sides.name;
    } else if (request.scale) {
        throw OptionError("-preview_scale needs a CRS with a known unit; name it with -a_srs.");
    }
    if (scale < least)
        refuse_scale(scale, sides, least,
                     request.landscape ? least : room_on(sides, true, format, words).least_scale(area));
    const double share = least / scale;
    const double aspect = aspect_ratio(area);
    const double width = std::min(room.width, room.height * aspect) * share;
    room.layout.map = {round_to_pixels(width), round_to_pixels(width / aspect)};
    return room.layout;
}

std::string draw_map_page(const MapPicture& map, writing::PictureFormat format, const PageLayout& layout,
                          const PageWords& words) {
    const double font = layout.font;
    const double width = layout.page.width - 2 * layout.margin;
    const Footer footer(width, font, line_count(words));
    FooterText text{map.legend, {summary(map.counts, layout)}};
    if (!words.credit.empty())
        text.lines.push_back(words.credit);
    text.lines.push_back(source_line(map.frame.area()));
    const double head = layout.margin + title_height(words, font);
    // On paper the footer is at the bottom, and the map in the middle of the room above it.
    const double foot = layout.on_paper ? layout.page.height - layout.margin - footer.height()
                                        : head + layout.map.height + layout.margin * 0.75;
    const double above = layout.on_paper ? (foot - gap_below * font - head - layout.map.height) / 2 : 0;
    return draw_page(layout.page, format, [&](cairo_t* pen) {
        draw_title(pen, {layout.page.width / 2.0, layout.margin}, font, width, words.title);
        paint(map, pen,
              {std::round(layout.margin + (width - layout.map.width) / 2), std::round(head + above)}, font);
        footer.draw(pen, {layout.margin, foot}, map.frame, text);
    });
}

SheetPlan plan_sheet(std::size_t trials, std::size_t across, int longest, PageWords words) {
    const auto most = static_cast<std::size_t>(std::max(longest / min_trial_px, 1));
    std::size_t columns = 1;
    while (columns * columns < trials)
        ++columns;
    if (across > 1 && across <= most && (trials + across - 1) / across <= most)
        columns = across;
    return {trials, static_cast<int>(columns), longest, std::move(words)};
}

PixelSize map_size_on_sheet(const MapArea& area, const SheetPlan& plan) {
    return lay_out_sheet(area, plan).map;
}

std::string draw_contact_sheet(std::span<const TrialPicture> trials, const SheetPlan& plan,
                               writing::PictureFormat format) {
    const MapPicture& first = trials.front().map;
    const SheetLayout sheet = lay_out_sheet(first.frame.area(), plan);
    const double width = sheet.page.width - 2 * sheet.gap;
    FooterText text{first.legend, {}};
    if (trials.size() > 1)
        text.lines.emplace_back(difference_note);
    if (!plan.words.credit.empty())
        text.lines.push_back(plan.words.credit);
    const Footer footer(width, sheet.font, static_cast<int>(text.lines.size()) + 1);
    const bool paler =
        std::ranges::any_of(trials, [](const TrialPicture& trial) { return trial.map.counts.paler; });
    text.lines.push_back(source_line(first.frame.area()) + (paler ? uncertain_note : ""));
    const double head = title_height(plan.words, sheet.font);
    return draw_page(sheet.page, format, [&](cairo_t* pen) {
        draw_title(pen, {sheet.page.width / 2.0, sheet.gap}, sheet.font, width, plan.words.title);
        for (std::size_t i = 0; i < trials.size(); ++i) {
            const auto columns = static_cast<std::size_t>(plan.columns);
            const std::size_t row = i / columns;
            const std::size_t col = i % columns;
            draw_trial(pen, trials[i], sheet,
                       {sheet.gap + static_cast<double>(col) * (sheet.cell_width + sheet.gap),
                        head + static_cast<double>(row) * sheet.cell_height});
        }
        footer.draw(pen, {sheet.gap, sheet.page.height - footer.height() - sheet.gap * 0.25}, first.frame,
                    text);
    });
}

}  // namespace d2b::view
