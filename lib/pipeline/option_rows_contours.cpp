#include "pipeline/option_rows.hpp"

namespace d2b::rows {
namespace {

/// A greedy list: "-fl 10 12.5 15".
OptionRow fixed_levels() {
    OptionRow row =
        described("fl", "<level> [<level>...]",
                  {.help = "Explicit thresholds, in place of those of -lod.",
                   .details = "Every number that follows is one; the option may be given again and then "
                              "adds levels. A file whose name is a number needs its path: ./12.",
                   .unit = "vertical unit of the input"});
    row.arity = Arity::list;
    row.repeatable = true;
    row.range = "numbers";
    row.apply = [](Request& request, OptionValues texts) {
        std::vector<double> levels;
        for (const std::string& text : texts) {
            const auto level = read_number({}, text);
            if (!level)
                refuse_value("fl", "numbers", text);
            levels.push_back(*level);
        }
        auto& all = request.options.levels.fixed;
        all.insert(all.end(), levels.begin(), levels.end());
    };
    row.show = [](const Request& request) {
        std::string text;
        for (double level : request.options.levels.fixed)
            text += (text.empty() ? "" : " ") + number_text(level);
        return text;
    };
    return row;
}

std::vector<OptionRow> noise() {
    std::vector<OptionRow> rows;
    rows.push_back(whole_row(
        "nf", "<points>", {.lowest = 0, .highest = 1000000000},
        [](auto& r) -> auto& { return r.options.filter.noise_factor; },
        {.help = "Noise factor: contours whose outline passes fewer grid points are dropped.",
         .details =
             "With a contour goes all that stands on it. Holes are filled by the same rule, unless something "
             "that is kept stands in them. 0 keeps everything.",
         .unit = "grid points"}));
    rows.push_back(number_row(
        "min_area", "<m2>", {.lowest = 0}, [](auto& r) -> auto& { return r.options.filter.min_area_m2; },
        {.help = "Drop contours and fill holes of a smaller area.",
         .details = "It works as -nf does and removes long thin rows of trees, which have long outlines.",
         .unit = "m2"}));
    return rows;
}

}  // namespace

std::vector<OptionRow> levels() {
    const Choices<std::string> presets{{"thesis", "thesis"}};
    std::vector<OptionRow> rows;
    rows.push_back(choice_row(
        "preset", "thesis", presets, [](auto& r) -> auto& { return r.options.preset; },
        {.help = "Method, with its defaults; the other options refine it.",
         .details =
             "thesis is the method of Chittineni (2003): thresholds from the mean and the standard deviation "
             "of all elevations, and collapsed contouring."}));
    rows.push_back(whole_row("lod", "<n>", {.lowest = 1, .highest = 10000},
                             [](auto& r) -> auto& { return r.options.levels.lod; },
                             {.help = "Level of detail: how many thresholds.",
                              .details = "They divide the range from one standard deviation below the mean "
                                         "elevation to one above it into "
                                         "n + 1 equal slices."}));
    rows.push_back(fixed_levels());
    rows.push_back(number_row("i", "<interval>", {.lowest = 0, .above_lowest = true},
                              [](auto& r) -> auto& { return r.options.levels.interval; },
                              {.help = "Interval between thresholds, in place of those of -lod.",
                               .unit = "vertical unit of the input"}));
    rows.push_back(number_row(
        "off", "<base>", {}, [](auto& r) -> auto& { return r.options.levels.offset; },
        {.help = "Elevation that the intervals of -i count from.", .unit = "vertical unit of the input"}));
    return rows;
}

std::vector<OptionRow> contours() {
    const Choices<TraceMode> modes{{"points", TraceMode::points}, {"cells", TraceMode::cells}};
    std::vector<OptionRow> rows;
    rows.push_back(choice_row(
        "trace", "points|cells", modes, [](auto& r) -> auto& { return r.options.trace.mode; },
        {.help = "What outlines are drawn through.",
         .details =
             "points: the outermost grid points above the threshold, so that a building loses half a cell on "
             "each side. cells: the borders of the cells around these points, so that areas are unbiased."}));
    for (OptionRow& row : noise())
        rows.push_back(std::move(row));
    rows.push_back(number_row(
        "simplify", "<tolerance>", {.lowest = 0}, [](auto& r) -> auto& { return r.options.outline.simplify; },
        {.help = "Simplify outlines; 0 keeps every corner.",
         .details =
             "Borders that polygons share move together: nesting, disjointness and validity hold. A contour "
             "that would break keeps its traced outline and is flagged.",
         .unit = "units of the input's CRS, degrees in a geographic one"}));
    rows.push_back(
        switch_row("disjoint", [](auto& r) -> auto& { return r.options.outline.disjoint; },
                   {.help = "Write contours as bands that do not overlap instead of stacked ones."}));
    return rows;
}

}  // namespace d2b::rows
