#include "options/option_rows.hpp"
#include "options/run_plan.hpp"

namespace d2b::rows {
namespace {

/// A greedy list: "-fl 10 12.5 15".
OptionRow fixed_levels() {
    OptionRow row =
        described("fl", OptionKind::numbers, "<level> [<level>...]",
                  {.title = "Levels at these elevations",
                   .help = "Explicit thresholds, in place of those of -lod.",
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
    row.texts = [](const Request& request) {
        Texts texts;
        std::ranges::transform(request.options.levels.fixed, std::back_inserter(texts), number_text);
        return texts;
    };
    return row;
}

std::vector<OptionRow> noise() {
    std::vector<OptionRow> rows;
    rows.push_back(whole_row(
        "nf", "<points>", {.lowest = 0, .highest = 1000000000},
        [](auto& r) -> auto& { return r.options.filter.noise_factor; },
        {.title = "Shortest outline of a part",
         .help = "Noise factor: contours whose outline passes fewer grid points are dropped.",
         .details =
             "With a contour goes all that stands on it. Holes are filled by the same rule, unless something "
             "that is kept stands in them. 0 keeps everything.",
         .unit = "grid points",
         .item = "NOISE_FACTOR"}));
    rows.push_back(number_row(
        "min_area", "<m2>", {.lowest = 0}, [](auto& r) -> auto& { return r.options.filter.min_area_m2; },
        {.title = "Smallest building to keep",
         .section = DialogSection::basic,
         .help = "Smallest area of a building; by default " + number_text(smallest_building_m2) + " m2.",
         .details =
             "With -preset thesis contours of a smaller area are dropped and such holes filled, as -nf does "
             "with short ones, which also removes long thin rows of trees; by default none is.",
         .unit = "m2",
         .item = "MIN_AREA_M2"}));
    return rows;
}

/// How outlines become walls.
OptionRow walls() {
    const Choices<Walls> choices{
        {"auto", Walls::automatic}, {"off", Walls::off}, {"right", Walls::right}, {"free", Walls::free}};
    return choice_row(
        "regularize", choices, [](auto& r) -> auto& { return r.options.outline.walls; },
        {.title = "Straight walls",
         .section = DialogSection::detail,
         .help = "Straight walls in place of the staircase that cells make.",
         .details =
             "auto: walls along a building's main directions and at right angles where the data support it, "
             "others as they run, circles and arcs where they fit. right: right angles alone. free: straight "
             "walls of any direction. off: the outline as it was traced. What does not fit within the "
             "tolerance keeps its traced outline. By default auto, off with -simplify or -preset thesis.",
         .item = "REGULARIZE"});
}

}  // namespace

std::vector<OptionRow> levels() {
    const Choices<LevelSource> sources{{"building", LevelSource::building},
                                       {"natural", LevelSource::natural},
                                       {"global", LevelSource::global}};
    std::vector<OptionRow> rows;
    rows.push_back(choice_row(
        "levels", sources, [](auto& r) -> auto& { return r.options.levels.source; },
        {.title = "What the levels divide",
         .help = "What the thresholds of -lod divide.",
         .details = "natural: the elevations of each building at their natural breaks, which lie between its "
                    "roofs; as many as are worth the borders that they make. building: the same in equal "
                    "slices. With both thresholds are at least half a metre apart. global: the elevations of "
                    "the whole input, one set for all, as -preset thesis does. By default natural, with "
                    "-preset thesis global.",
         .scope = where_buildings_are_found("global"),
         .item = "LEVELS"}));
    rows.push_back(whole_row(
        "lod", "<n>", {.lowest = 1, .highest = 10000}, [](auto& r) -> auto& { return r.options.levels.lod; },
        {.title = "Number of levels in a building",
         .section = DialogSection::detail,
         .help = "Level of detail: how many thresholds.",
         .details = "They divide the range from one standard deviation below the mean "
                    "elevation to one above it into "
                    "n + 1 equal slices; with -levels natural n is the largest number of "
                    "breaks in a building.",
         .item = "LOD"}));
    rows.push_back(number_row(
        "detail", "<height>", {.lowest = 0, .highest = 1000},
        [](auto& r) -> auto& { return r.options.levels.detail; },
        {.title = "Smallest step of a roof",
         .section = DialogSection::detail,
         .help = "Clean tiers: what stands out by less than this, as a strip one metre wide, belongs to the "
                 "roof beside it.",
         .details =
             "So does what is narrower than two cells: chimneys, dormers, edges that a wall smears. Wider "
             "strips may stand out by less, narrower ones must by more. A larger height gives fewer "
             "contours with fewer vertices; 0 keeps every cell's own elevation. By default " +
             number_text(usual_detail_m) + ", with -preset thesis 0.",
         .unit = "m",
         .scope = where_buildings_are_found("0"),
         .item = "DETAIL_M"}));
    rows.push_back(fixed_levels());
    rows.push_back(number_row("i", "<interval>", {.lowest = 0, .above_lowest = true},
                              [](auto& r) -> auto& { return r.options.levels.interval; },
                              {.title = "Interval between levels",
                               .help = "Interval between thresholds, in place of those of -lod.",
                               .unit = "vertical unit of the input"}));
    rows.push_back(number_row("off", "<base>", {}, [](auto& r) -> auto& { return r.options.levels.offset; },
                              {.title = "Elevation that the intervals count from",
                               .help = "Elevation that the intervals of -i count from.",
                               .unit = "vertical unit of the input"}));
    return rows;
}

std::vector<OptionRow> contours() {
    const Choices<TraceMode> modes{{"points", TraceMode::points}, {"cells", TraceMode::cells}};
    std::vector<OptionRow> rows;
    rows.push_back(choice_row(
        "trace", modes, [](auto& r) -> auto& { return r.options.trace.mode; },
        {.title = "What outlines are drawn through",
         .help = "What outlines are drawn through.",
         .details =
             "By default cells, with -preset thesis points. "
             "points: the outermost grid points above the threshold, so that a building loses half a cell on "
             "each side. cells: the borders of the cells around these points, so that areas are unbiased.",
         .item = "TRACE"}));
    for (OptionRow& row : noise())
        rows.push_back(std::move(row));
    rows.push_back(walls());
    rows.push_back(
        switch_row("arcs", [](auto& r) -> auto& { return r.options.outline.arcs; },
                   {.title = "Round walls as arcs",
                    .help = "Write round walls as circular arcs where the format has them.",
                    .details = "Without it, and elsewhere, they are written as short straight pieces.",
                    .python = Python::extract_file}));
    rows.push_back(number_row(
        "regularize_tolerance", "<cells>", {.lowest = 0, .highest = 100, .above_lowest = true},
        [](auto& r) -> auto& { return r.options.outline.wall_tolerance; },
        {.title = "Tolerance of straight walls",
         .help = "How far a regularized outline may leave its trace; by default " +
                 number_text(wall_tolerance_cells) + ", but at most " + number_text(wall_tolerance_m) +
                 " m, and at least " + number_text(least_wall_tolerance_cells) + ".",
         .unit = "cells"}));
    rows.push_back(number_row(
        "simplify", "<tolerance>", {.lowest = 0}, [](auto& r) -> auto& { return r.options.outline.simplify; },
        {.title = "Tolerance of simplified outlines",
         .help = "Simplify outlines; 0 keeps every corner.",
         .details =
             "Borders that polygons share move together: nesting, disjointness and validity hold. A contour "
             "that would break keeps its traced outline and is flagged.",
         .unit = "units of the input's CRS, degrees in a geographic one",
         .item = "SIMPLIFY"}));
    rows.push_back(
        switch_row("disjoint", [](auto& r) -> auto& { return r.options.outline.disjoint; },
                   {.title = "Parts that do not overlap",
                    .section = DialogSection::output,
                    .help = "Write contours as bands that do not overlap instead of stacked ones."}));
    return rows;
}

}  // namespace d2b::rows
