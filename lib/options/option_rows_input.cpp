#include <algorithm>
#include <cmath>
#include <string>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "options/option_rows.hpp"

namespace d2b::rows {
namespace {

/// Takes "m", "ft", "us-ft" or metres in a unit.
OptionRow vertical_unit() {
    const NumberRange metres{.lowest = 0, .above_lowest = true};
    const Texts units{"m", "ft", "us-ft"};
    OptionRow row = make_row(
        "zunit", OptionKind::text, joined(units, "|") + "|<metres>",
        {.title = "Unit of the elevations",
         .help = "Unit of the elevations.",
         .details =
             "ft is the international foot, us-ft the US survey foot; a number is the length of the unit in "
             "metres. By default the first known unit of the band, the vertical and the horizontal CRS."});
    row.choices = units;
    Texts all = units;
    all.push_back(metres.text("a number") + " (metres in one unit)");
    row.range = alternatives(all);
    row.apply = [metres, units, range = row.range](Request& request, OptionValues texts) {
        const std::string& text = texts[0];
        if (std::ranges::find(units, text) == units.end() && !read_number(metres, text))
            refuse_value("zunit", range, text);
        request.options.read.vertical_unit = text;
    };
    row.texts = [](const Request& request) {
        const std::string& unit = request.options.read.vertical_unit;
        return unit.empty() ? Texts{} : Texts{unit};
    };
    return row;
}

/// Range of valid elevations.
OptionRow elevation_range() {
    return several_row<2>(
        "zrange", OptionKind::numbers, "<lowest> <highest>", "two numbers, the lowest below the highest",
        [](const Two& range) { return range[0] < range[1]; },
        [](auto& r) -> auto& { return r.options.read.elevation_range; },
        {.title = "Range of valid elevations",
         .help = "Range of valid elevations; values outside count as no data.",
         .details = "Also applies to -ground. By default -500 to 9000 m, because no land is lower or higher.",
         .unit = "vertical unit of the input"});
}

bool whole(double value) {
    return value == std::floor(value);
}

/// Detects the upper left corner given first, because some GDAL tools take it first and others the lower
/// left. @throws OptionError
void require_lower_left_first(const Four& extent) {
    const auto& [left, top, right, bottom] = extent;
    if (left < right && top > bottom)
        throw OptionError(
            "-te takes xmin ymin xmax ymax, and " + numbers_text(extent, " ") +
            " is the upper left and the lower right corner, as -projwin takes them; write -te " +
            numbers_text(Four{left, bottom, right, top}, " ") + ".");
}

/// Options that select a part of the input.
std::vector<OptionRow> windows() {
    std::vector<OptionRow> rows;
    rows.push_back(several_row<4>(
        "srcwin", OptionKind::numbers, "<column> <row> <columns> <rows>",
        "four whole numbers, columns and rows above 0",
        [](const Four& w) { return std::ranges::all_of(w, whole) && w[2] > 0 && w[3] > 0; },
        [](auto& r) -> auto& { return r.options.read.source_window; },
        {.title = "Part of the raster, in cells",
         .help = "Part of the input to use, in cells from its upper left corner.",
         .unit = "cells"}));
    rows.push_back(several_row<4>(
        "projwin", OptionKind::numbers, "<ulx> <uly> <lrx> <lry>",
        "four numbers, ulx below lrx and uly above lry",
        [](const Four& w) { return w[0] < w[2] && w[1] > w[3]; },
        [](auto& r) -> auto& { return r.options.read.projected_window; },
        {.title = "Part of the raster, by its corners",
         .help = "Part of the input to use, by its upper left and lower right corner.",
         .unit = "units of the input's CRS"}));
    rows.push_back(several_row<4>(
        "te", OptionKind::extent, "<xmin> <ymin> <xmax> <ymax>",
        "four numbers, xmin below xmax and ymin below ymax",
        [](const Four& w) {
            require_lower_left_first(w);
            return w[0] < w[2] && w[1] < w[3];
        },
        [](auto& r) -> auto& { return r.options.read.extent; },
        {.title = "Extent to use (all if not set)",
         .section = DialogSection::basic,
         .everyday = true,
         .help = "Part of the input to use: the points within this rectangle.",
         .unit = "units of the input's CRS"}));
    rows.push_back(text_row("cutline", OptionKind::polygons, "<polygons>",
                            [](auto& r) -> auto& { return r.options.read.cutline; },
                            {.title = "Area of interest (polygons)",
                             .help = "Polygons that bound the area of interest.",
                             .details = "Points outside are not used."}));
    rows.push_back(text_row("cutline_layer", OptionKind::text, "<layer>",
                            [](auto& r) -> auto& { return r.options.read.cutline_layer; },
                            {.title = "Layer of the area of interest",
                             .help = "Layer of -cutline; by default the first with geometries."}));
    return rows;
}

}  // namespace

std::vector<OptionRow> input() {
    std::vector<OptionRow> rows;
    rows.push_back(integer_row(
        "b", "<band>", {.lowest = 1, .highest = 65536}, [](auto& r) -> auto& { return r.options.read.band; },
        {.title = "Band of the elevations", .help = "Band that holds the elevations."}));
    rows.push_back(list_row(
        "oo", "<NAME>=<VALUE>", "NAME=VALUE", [](auto& r) -> auto& { return r.options.read.open_options; },
        {.title = "Open options of the raster's format", .help = "Open option of the input's format."}));
    rows.push_back(list_row("if", "<format>", "", [](auto& r) -> auto& { return r.options.read.drivers; },
                            {.title = "Format of the raster",
                             .help = "Format to try on the input.",
                             .details = "A short name of GDAL's, see --formats; by default all are tried.",
                             .python_name = "input_format"}));
    rows.push_back(text_row("a_srs", OptionKind::crs, "<crs>",
                            [](auto& r) -> auto& { return r.options.read.crs; },
                            {.title = "Coordinate system of the raster",
                             .help = "CRS of the input, instead of its own.",
                             .details = "A code such as EPSG:25832, or EPSG:25832+7837 with a vertical CRS; "
                                        "WKT, PROJJSON or a PROJ string. Nothing is reprojected.",
                             .python_name = "crs"}));
    rows.push_back(number_row(
        "snodata", "<value>", {}, [](auto& r) -> auto& { return r.options.read.nodata; },
        {.title = "Value that stands for no data",
         .help = "Value that stands for no data, instead of the input's own.",
         .details =
             "Compared with the stored values, before scale and offset. NaN and infinity are never valid.",
         .python_name = "nodata"}));
    rows.push_back(switch_row("inodata", [](auto& r) -> auto& { return r.options.read.ignore_nodata; },
                              {.title = "Treat the NoData value as an elevation",
                               .help = "Treat the input's NoData value as an elevation.",
                               .details = "Values that look like undeclared NoData are kept too: values that "
                                          "many cells along the edge share, far from all others."}));
    for (OptionRow& row : windows())
        rows.push_back(std::move(row));
    rows.push_back(vertical_unit());
    rows.push_back(elevation_range());
    return rows;
}

}  // namespace d2b::rows
