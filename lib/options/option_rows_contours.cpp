#include "options/option_rows.hpp"
#include "options/run_plan.hpp"

namespace d2b::rows {
namespace {

/// Takes all numbers that follow: "-fl 10 12.5 15".
OptionRow fixed_levels() {
    OptionRow row = make_row(
        "fl", OptionKind::numbers, "<level> [<level>...]",
        {.title = "Levels at these elevations",
         .help = "Thresholds at these elevations, instead of those of -lod.",
         .details = "Takes all numbers that follow. A file whose name is a number needs its path: ./12.",
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

OptionRow noise_factor() {
    return integer_row(
        "nf", "<points>", {.lowest = 0, .highest = 1000000000},
        [](auto& r) -> auto& { return r.options.filter.noise_factor; },
        {.title = "Shortest outline of a part",
         .help = "Noise factor: drop contours whose outline passes fewer grid points.",
         .details = "Contours on top of them are dropped too. Holes are filled by the same rule, "
                    "unless a kept contour stands in them. 0 keeps everything.",
         .unit = "grid points",
         .item = "NOISE_FACTOR"});
}

/// Options for flow solvers.
std::vector<OptionRow> flow() {
    constexpr double most = 100;
    std::vector<OptionRow> rows;
    rows.push_back(number_row(
        "flow_ready", "<m>", {.lowest = 0, .highest = most},
        [](auto& r) -> auto& { return r.options.outline.flow_ready; },
        {.title = "Outlines for flow solvers",
         .help = "Close gaps and courtyards narrower than this, merge shorter walls, and widen narrower "
                 "parts of buildings.",
         .details = "Corners below 20.7 degrees and corners that touch are removed, too. Places whose change "
                    "would be too large are left; -write_problems shows them.",
         .unit = "m"}));
    rows.push_back(number_row("min_gap", "<m>", {.lowest = 0, .highest = most},
                              [](auto& r) -> auto& { return r.options.outline.min_gap; },
                              {.title = "Narrowest gap",
                               .help = "The limit for gaps and courtyards; by default that of -flow_ready.",
                               .unit = "m"}));
    rows.push_back(number_row(
        "min_wall", "<m>", {.lowest = 0, .highest = most},
        [](auto& r) -> auto& { return r.options.outline.min_wall; },
        {.title = "Shortest wall",
         .help = "The limit for walls and narrow parts of buildings; by default that of -flow_ready.",
         .details = "Corners that touch are moved apart by up to this length.",
         .unit = "m"}));
    return rows;
}

/// Regularization of outlines.
OptionRow walls() {
    const Choices<Walls> choices{
        {"auto", Walls::automatic}, {"off", Walls::off}, {"right", Walls::right}, {"free", Walls::free}};
    return choice_row(
        "regularize", choices, [](auto& r) -> auto& { return r.options.outline.walls; },
        {.title = "Straight walls",
         .section = DialogSection::detail,
         .help = "Straight walls instead of the staircase of the cells.",
         .details =
             "auto: along the main directions of a building and at right angles where the data support it, "
             "otherwise in any direction; circles and arcs where they fit. right: one main direction and "
             "right "
             "angles. free: any direction. off: outlines as traced. By default auto; off with -simplify or "
             "-preset thesis.",
         .choice_titles = {"Best fit", "Off: as traced", "Right angles", "Any direction"},
         .item = "REGULARIZE"});
}

}  // namespace

std::vector<OptionRow> levels() {
    const Choices<LevelSource> sources{{"building", LevelSource::building},
                                       {"natural", LevelSource::natural},
                                       {"global", LevelSource::global}};
    std::vector<OptionRow> rows;
    rows.push_back(
        choice_row("levels", sources, [](auto& r) -> auto& { return r.options.levels.source; },
                   {.title = "How levels are chosen",
                    .help = "How -lod chooses thresholds.",
                    .details = "natural: per building, between its roofs (natural breaks of its elevations), "
                               "as many as are worth their borders. building: per building, in equal slices. "
                               "In both, thresholds are at least half a metre apart. global: one set for the "
                               "whole input. By default natural, with -preset thesis global.",
                    .choice_titles = {"Equal slices of each building", "Between the roofs of each building",
                                      "One set for the whole raster"},
                    .scope = detection_scope("global"),
                    .item = "LEVELS"}));
    rows.push_back(integer_row(
        "lod", "<n>", {.lowest = 1, .highest = 10000}, [](auto& r) -> auto& { return r.options.levels.lod; },
        {.title = "Number of levels in a building",
         .section = DialogSection::detail,
         .help = "Level of detail: the number of thresholds.",
         .details =
             "With -levels natural the maximum per building. Otherwise the thresholds divide the range from "
             "one standard deviation below the mean elevation to one above it into n + 1 equal slices.",
         .item = "LOD"}));
    rows.push_back(number_row(
        "detail", "<height>", {.lowest = 0, .highest = 1000},
        [](auto& r) -> auto& { return r.options.levels.detail; },
        {.title = "Smallest step of a roof",
         .section = DialogSection::detail,
         .help = "Smallest step of a roof: a strip one metre wide (or one cell, if larger) that "
                 "stands out by less joins the roof next to it.",
         .details = "So do parts narrower than two cells, such as chimneys. 0 keeps all. By default " +
                    number_text(default_detail_m) + ", with -preset thesis 0.",
         .unit = "m",
         .scope = detection_scope("0"),
         .item = "DETAIL_M"}));
    rows.push_back(fixed_levels());
    rows.push_back(number_row("i", "<interval>", {.lowest = 0, .above_lowest = true},
                              [](auto& r) -> auto& { return r.options.levels.interval; },
                              {.title = "Interval between levels",
                               .help = "Interval between thresholds, instead of those of -lod.",
                               .unit = "vertical unit of the input"}));
    rows.push_back(number_row("off", "<base>", {}, [](auto& r) -> auto& { return r.options.levels.offset; },
                              {.title = "Base elevation of the interval",
                               .help = "Elevation from which the intervals of -i count.",
                               .unit = "vertical unit of the input"}));
    return rows;
}

std::vector<OptionRow> contours() {
    const Choices<TraceMode> modes{{"points", TraceMode::points}, {"cells", TraceMode::cells}};
    std::vector<OptionRow> rows;
    rows.push_back(choice_row(
        "trace", modes, [](auto& r) -> auto& { return r.options.trace.mode; },
        {.title = "Path of the outlines",
         .help = "Path of the outlines: through grid points, or along the borders of cells.",
         .details = "points: through the outermost grid points above the threshold; a building loses half a "
                    "cell on each side. cells: along the borders of the cells of these points; areas are "
                    "unbiased. By default cells, with -preset thesis points.",
         .choice_titles = {"Through grid points", "Along the borders of cells"},
         .item = "TRACE"}));
    rows.push_back(noise_factor());
    rows.push_back(walls());
    rows.push_back(switch_row("arcs", [](auto& r) -> auto& { return r.options.outline.arcs; },
                              {.title = "Round walls as arcs",
                               .help = "Write round walls as circular arcs if the format has them.",
                               .details = "By default they are short straight lines.",
                               .python = Python::extract_file}));
    for (OptionRow& row : flow())
        rows.push_back(std::move(row));
    rows.push_back(number_row(
        "regularize_tolerance", "<cells>", {.lowest = 0, .highest = 100, .above_lowest = true},
        [](auto& r) -> auto& { return r.options.outline.wall_tolerance; },
        {.title = "Tolerance of straight walls",
         .help =
             "Largest distance between a straight wall and the cell borders that it replaces, measured to "
             "their midpoints; by default " +
             number_text(wall_tolerance_m) + " m, but at least " + number_text(min_wall_tolerance_cells) +
             " cells.",
         .unit = "cells"}));
    rows.push_back(number_row(
        "wall_inset", "<cells>", {.lowest = 0, .highest = 1},
        [](auto& r) -> auto& { return r.options.outline.wall_inset; },
        {.title = "Straight walls inward by",
         .help = "Move straight walls inward, for rasters whose cells hold the highest of several points.",
         .details = "Walls move as far as -regularize_tolerance lets them.",
         .unit = "cells"}));
    rows.push_back(number_row("simplify", "<tolerance>", {.lowest = 0},
                              [](auto& r) -> auto& { return r.options.outline.simplify; },
                              {.title = "Tolerance of simplified outlines",
                               .help = "Simplify outlines; 0 keeps every corner.",
                               .details = "Polygons stay nested, disjoint and valid. A contour that would "
                                          "break keeps its traced outline and is flagged.",
                               .unit = "units of the input's CRS",
                               .item = "SIMPLIFY"}));
    rows.push_back(switch_row("disjoint", [](auto& r) -> auto& { return r.options.outline.disjoint; },
                              {.title = "Parts that do not overlap",
                               .section = DialogSection::output,
                               .help = "Write contours as bands that do not overlap, instead of a stack."}));
    return rows;
}

}  // namespace d2b::rows
