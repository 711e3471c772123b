#include <algorithm>
#include <cmath>

#include "options/option_rows.hpp"

namespace d2b::rows {
namespace {

std::vector<OptionRow> dataset() {
    std::vector<OptionRow> rows;
    rows.push_back(
        text_row("f", OptionKind::text, "<format>", [](auto& r) -> auto& { return r.options.write.format; },
                 {.title = "Format of the result",
                  .help = "Format of the output; by default from the extension of the file name.",
                  .details = "A short name of GDAL's, see --formats, such as GPKG or \"ESRI Shapefile\".",
                  .aliases = {"of", "output_format"},
                  .python = Python::extract_file}));
    rows.push_back(list_row("dsco", "<NAME>=<VALUE>", "NAME=VALUE",
                            [](auto& r) -> auto& { return r.options.write.dataset_options; },
                            {.title = "Creation options of the file",
                             .help = "Creation option of the output's format.",
                             .aliases = {"co"},
                             .python = Python::extract_file}));
    rows.push_back(list_row("lco", "<NAME>=<VALUE>", "NAME=VALUE",
                            [](auto& r) -> auto& { return r.options.write.layer_options; },
                            {.title = "Creation options of the layers",
                             .help = "Creation option of the output's layers.",
                             .python = Python::extract_file}));
    rows.push_back(text_row(
        "nln", OptionKind::text, "<name>", [](auto& r) -> auto& { return r.options.write.layer_name; },
        {.title = "Name of the layers",
         .help = "Name of the output's layer.",
         .details = "With both layers it names the buildings, and the contours go to <name>_contours.",
         .python = Python::extract_file}));
    rows.push_back(switch_row("overwrite", [](auto& r) -> auto& { return r.options.write.overwrite; },
                              {.title = "Replace layers of the same names",
                               .everyday = true,
                               .help = "Replace layers of the same names in an existing output.",
                               .details = "Other layers of a GeoPackage or SQLite file stay. Files of other "
                                          "formats are refused if they hold other layers.",
                               .python = Python::extract_file,
                               .repeats = false}));
    rows.push_back(switch_row("append", [](auto& r) -> auto& { return r.options.write.append; },
                              {.title = "Add to layers of the same names",
                               .help = "Add to layers of the same names in an existing output.",
                               .python = Python::extract_file,
                               .repeats = false}));
    return rows;
}

/// Options of building surfaces.
std::vector<OptionRow> surface() {
    const Choices<SurfaceOf> of{
        {"buildings", SurfaceOf::buildings}, {"contours", SurfaceOf::contours}, {"roofs", SurfaceOf::roofs}};
    const Choices<SurfaceRoof> roofs{{"mean", SurfaceRoof::mean}, {"p50", SurfaceRoof::p50},
                                     {"p70", SurfaceRoof::p70},   {"p90", SurfaceRoof::p90},
                                     {"p95", SurfaceRoof::p95},   {"max", SurfaceRoof::max}};
    const auto whole = [](const Three& metres) {
        return std::ranges::all_of(metres, [](double m) { return std::isfinite(m) && m == std::round(m); });
    };
    std::vector<OptionRow> rows;
    OptionRow files = list_row(
        "surface", "<file>", "", [](auto& r) -> auto& { return r.options.write.surfaces; },
        {.title = "Surface of the buildings",
         .section = DialogSection::output,
         .everyday = true,
         .help = "Also write the buildings as closed surfaces.",
         .details =
             "The extension is .city.json, .obj, .stl or .glb. CityJSON has one solid per building, in the "
             "CRS. The others have blocks of touching buildings, in metres from a local origin.",
         .python = Python::extract_file,
         .repeats = false});
    files.kind = OptionKind::surface;
    rows.push_back(std::move(files));
    rows.push_back(
        choice_row("surface_of", of, [](auto& r) -> auto& { return r.options.write.surface_of; },
                   {.title = "Model of the surface",
                    .section = DialogSection::output,
                    .help = "Model of the surface.",
                    .details = "buildings: one block with a flat roof per building. contours: the tiers of "
                               "each building's stack. roofs: the planes of each roof, LoD2.2. By default "
                               "buildings, with -preset thesis contours.",
                    .choice_titles = {"Blocks with flat roofs", "Tiers of each building", "Slanted roofs"},
                    .python = Python::extract_file,
                    .repeats = false}));
    rows.push_back(choice_row(
        "surface_roof", roofs, [](auto& r) -> auto& { return r.options.write.surface_roof; },
        {.title = "Height of the flat roofs",
         .section = DialogSection::output,
         .help = "Height of the flat roofs of -surface_of buildings.",
         .details = "mean is the mean height of a building's points, so that its block encloses volume_m3.",
         .choice_titles = {"Mean height", "Median height", "70th percentile", "90th percentile",
                           "95th percentile", "Highest point"},
         .python = Python::extract_file,
         .repeats = false}));
    const Choices<SurfaceSolids> solids{{"one", SurfaceSolids::one}, {"each", SurfaceSolids::each}};
    rows.push_back(choice_row(
        "surface_solids", solids, [](auto& r) -> auto& { return r.options.write.surface_solids; },
        {.title = "Objects of an OBJ, solids of an STL",
         .section = DialogSection::output,
         .help = "Objects of an OBJ and solids of an STL: one in all, or one per building.",
         .details = "one suits programs that read only the first solid, or slow down with many objects.",
         .choice_titles = {"One for all", "One per building"},
         .python = Python::extract_file,
         .repeats = false}));
    rows.push_back(
        several_row<3>("surface_origin", OptionKind::numbers, "<x> <y> <z>", "three whole numbers", whole,
                       [](auto& r) -> auto& { return r.options.write.surface_origin; },
                       {.title = "Origin of the surface",
                        .help = "Origin of the local coordinates of the surface, in metres.",
                        .details = "By default the middle of the window, below the lowest elevation.",
                        .unit = "m",
                        .python = Python::extract_file,
                        .repeats = false}));
    return rows;
}

/// Options of additional output, and of field names.
std::vector<OptionRow> also_written() {
    const Choices<FieldNames> names{{"own", FieldNames::own},
                                    {"urock", FieldNames::urock},
                                    {"city4cfd", FieldNames::city4cfd},
                                    {"osm", FieldNames::osm}};
    std::vector<OptionRow> rows;
    rows.push_back(choice_row("fields", names, [](auto& r) -> auto& { return r.options.write.fields; },
                              {.title = "Names of the fields",
                               .section = DialogSection::output,
                               .help = "Names of the fields of buildings, as another program expects them.",
                               .details = "urock and city4cfd are wind models, osm is OpenStreetMap. Names "
                                          "that are too long for a Shapefile are refused.",
                               .choice_titles = {"dem2buildings", "URock", "City4CFD", "OpenStreetMap"}}));
    rows.push_back(number_row("storey_height", "<m>", {.lowest = 0, .above_lowest = true},
                              [](auto& r) -> auto& { return r.options.write.storey_height; },
                              {.title = "Height of a storey",
                               .help = "Height of a storey, for the number of floors.",
                               .details = "Halls, churches and chimneys have no number of floors.",
                               .unit = "m"}));
    rows.push_back(switch_row(
        "roofs", [](auto& r) -> auto& { return r.options.write.roofs; },
        {.title = "Also write the planes of roofs",
         .section = DialogSection::output,
         .everyday = true,
         .help = "Also write a layer of the faces of roofs, with their slopes and azimuths.",
         .details =
             "It is called roofs, or <name>_roofs with -nln; its polygons have the elevations of their "
             "corners. -detail says how small a step is drawn.",
         .scope = detection_scope()}));
    rows.push_back(number_row("roof_min_area", "<m2>", {.lowest = 0},
                              [](auto& r) -> auto& { return r.options.roofs.min_area_m2; },
                              {.title = "Smallest face of a roof",
                               .help = "Smallest face of a roof; smaller ones are merged with a neighbour.",
                               .details = "15 leaves dormers out.",
                               .unit = "m2",
                               .scope = detection_scope()}));
    rows.push_back(switch_row(
        "write_doubtful", [](auto& r) -> auto& { return r.options.write.doubtful; },
        {.title = "Also write uncertain objects",
         .section = DialogSection::trees,
         .help = "Also write a layer of objects that may be buildings, with the reason for the doubt.",
         .details = "It is called doubtful, or <name>_doubtful with -nln.",
         .scope = detection_scope()}));
    rows.push_back(switch_row("write_rejected", [](auto& r) -> auto& { return r.options.write.rejected; },
                              {.title = "Also write dropped and changed contours",
                               .help = "Also write a layer of contours and holes that were dropped, filled "
                                       "or kept as traced, with the reason.",
                               .details = "It is called rejected, or <name>_rejected with -nln."}));
    rows.push_back(
        switch_row("write_problems", [](auto& r) -> auto& { return r.options.write.problems; },
                   {.title = "Also write the problems of the surface",
                    .help = "Also write a layer of points where outlines were unfit for a surface.",
                    .details = "It is called problems, or <name>_problems with -nln."}));
    rows.push_back(text_row("write_ground", OptionKind::geotiff, "<file.tif>",
                            [](auto& r) -> auto& { return r.options.write.ground; },
                            {.title = "Terrain as a GeoTIFF",
                             .section = DialogSection::ground,
                             .help = "Also write the terrain as a GeoTIFF, in metres.",
                             .scope = detection_scope(),
                             .python = Python::extract_file,
                             .repeats = false}));
    rows.push_back(text_row("write_height", OptionKind::geotiff, "<file.tif>",
                            [](auto& r) -> auto& { return r.options.write.height; },
                            {.title = "Heights above the terrain as a GeoTIFF",
                             .section = DialogSection::ground,
                             .help = "Also write the heights above the terrain as a GeoTIFF, in metres.",
                             .scope = detection_scope(),
                             .python = Python::extract_file,
                             .repeats = false}));
    rows.push_back(text_row("write_canopy", OptionKind::geotiff, "<file.tif>",
                            [](auto& r) -> auto& { return r.options.write.canopy; },
                            {.title = "Heights of trees as a GeoTIFF",
                             .section = DialogSection::trees,
                             .help = "Also write the heights of trees as a GeoTIFF, in metres; 0 elsewhere.",
                             .details = "Trees are everything above -min_height that is not a building.",
                             .scope = detection_scope(),
                             .python = Python::extract_file,
                             .repeats = false}));
    for (OptionRow& row : surface())
        rows.push_back(std::move(row));
    rows.push_back(text_row("page", OptionKind::page, "<file.html>",
                            [](auto& r) -> auto& { return r.options.write.page; },
                            {.title = "Page of the buildings in 3D",
                             .section = DialogSection::output,
                             .everyday = true,
                             .help = "Also write a page that shows the buildings in 3D in a browser.",
                             .details = "One file that works without a network, with a slider through the "
                                        "levels and a flat map to print.",
                             .python = Python::extract_file,
                             .repeats = false}));
    rows.push_back(text_row(
        "preview", OptionKind::picture, "<file>", [](auto& r) -> auto& { return r.options.write.preview; },
        {.title = "Picture of the result",
         .section = DialogSection::output,
         .everyday = true,
         .help = "Also write a picture of the result over the shaded relief.",
         .details = "The name ends in .png, .svg or .pdf. It helps to judge -lod and -nf.",
         .python = Python::extract_file,
         .repeats = false}));
    rows.push_back(integer_row("preview_size", "<pixels>", {.lowest = 300, .highest = 10000},
                               [](auto& r) -> auto& { return r.options.write.preview_size; },
                               {.title = "Longer side of the picture",
                                .section = DialogSection::output,
                                .help = "Longer side of the picture of -preview.",
                                .details = "In SVG and PDF a pixel is 1/96 inch.",
                                .unit = "pixels",
                                .python = Python::extract_file,
                                .repeats = false}));
    return rows;
}

/// Options of maps on paper, and of texts on maps and pages.
std::vector<OptionRow> on_paper() {
    const Choices<Paper> papers{{"A0", Paper::a0}, {"A1", Paper::a1}, {"A2", Paper::a2},
                                {"A3", Paper::a3}, {"A4", Paper::a4}, {"A5", Paper::a5}};
    std::vector<OptionRow> rows;
    rows.push_back(choice_row("preview_paper", papers,
                              [](auto& r) -> auto& { return r.options.write.preview_paper; },
                              {.title = "Paper of the picture",
                               .section = DialogSection::output,
                               .help = "Draw the picture of -preview as a page of this size.",
                               .details = "A PNG has 150 pixels per inch.",
                               .python = Python::extract_file,
                               .repeats = false}));
    OptionRow& scale =
        rows.emplace_back(number_row("preview_scale", "<denominator>", {.lowest = 1, .highest = 1e8},
                                     [](auto& r) -> auto& { return r.options.write.preview_scale; },
                                     {.title = "Scale of the map on paper, such as 1000 for 1:1000",
                                      .section = DialogSection::output,
                                      .help = "Scale of the map on -preview_paper, such as 1000 or 1:1000.",
                                      .details = "By default the largest round scale at which the area fits.",
                                      .python = Python::extract_file,
                                      .repeats = false}));
    scale.apply = [apply = scale.apply](Request& request, OptionValues texts) {
        const std::string& text = texts[0];
        const bool is_ratio = text.starts_with("1:") && looks_like_number(text.substr(2));
        apply(request, Texts{is_ratio ? text.substr(2) : text});
    };
    rows.push_back(switch_row("landscape", [](auto& r) -> auto& { return r.options.write.landscape; },
                              {.title = "Paper in landscape format",
                               .section = DialogSection::output,
                               .help = "Turn -preview_paper so that it is wider than high.",
                               .python = Python::extract_file,
                               .repeats = false}));
    rows.push_back(text_row("title", OptionKind::text, "<text>",
                            [](auto& r) -> auto& { return r.options.write.title; },
                            {.title = "Title",
                             .section = DialogSection::output,
                             .help = "Title of the page and the picture.",
                             .details = "By default a page has the name of its file.",
                             .python = Python::extract_file,
                             .repeats = false}));
    rows.push_back(text_row("credit", OptionKind::text, "<text>",
                            [](auto& r) -> auto& { return r.options.write.credit; },
                            {.title = "Source and licence of the data",
                             .section = DialogSection::output,
                             .help = "Source and licence of the data, for the page and the picture.",
                             .python = Python::extract_file,
                             .repeats = false}));
    return rows;
}

/// Accepts gdal_contour's switch for polygons, so that its command lines work here.
OptionRow polygons() {
    OptionRow row = make_row(
        "p", OptionKind::toggle, "",
        {.help = "Accepted; polygons are always written.", .python = Python::none, .repeats = false});
    row.hidden = true;
    row.apply = [](Request&, OptionValues) {};
    row.texts = [](const Request&) { return Texts{}; };
    return row;
}

OptionRow sweep() {
    OptionRow row = make_row(
        "sweep", OptionKind::text, "<option>=<from>..<to>[,<option>=<from>..<to>...]",
        {.title = "Trials",
         .help = "Try every combination of these values, and print a table; nothing else is written.",
         .details =
             "Leave the destination out. Any option that takes one number and changes buildings or "
             "contours can vary, such as lod=1..6,min_area=10..60. The table has buildings, contours, "
             "points, the distance of the stack to the input (root mean square) and seconds. Below it "
             "are options that change nothing from some value on. With -preview the program also draws a "
             "contact sheet, on which differences from the first trial are blue. Of more than six "
             "values it tries six; a third number is the step: nf=5..60..5."});
    row.apply = [](Request& request, OptionValues texts) {
        request.tool.sweep_plan = parse_sweep(texts[0]);
        request.tool.sweep = texts[0];
    };
    row.texts = [](const Request& request) {
        return request.tool.sweep.empty() ? Texts{} : Texts{request.tool.sweep};
    };
    return row;
}

}  // namespace

std::vector<OptionRow> output() {
    const Choices<Layers> layers{
        {"buildings", Layers::buildings}, {"contours", Layers::contours}, {"both", Layers::both}};
    std::vector<OptionRow> rows;
    rows.push_back(choice_row(
        "layers", layers, [](auto& r) -> auto& { return r.options.write.layers; },
        {.title = "Layers to write",
         .section = DialogSection::output,
         .help = "Layers to write.",
         .details = "buildings: one polygon per building. contours: the stacked polygons of all levels. By "
                    "default both, or only buildings if the format holds one layer per file.",
         .choice_titles = {"Buildings", "Contours (parts of buildings)", "Both"}}));
    rows.push_back(text_row(
        "t_srs", OptionKind::crs, "<crs>", [](auto& r) -> auto& { return r.options.outline.target_crs; },
        {.title = "Coordinate system of the result",
         .section = DialogSection::output,
         .everyday = true,
         .help = "CRS of the output; by default the input's.",
         .details = "Given as for -a_srs. Features that it splits (across 180 degrees, over a pole) are left "
                    "out with a warning; if it splits the whole area, the run is refused."}));
    rows.push_back(switch_row("3d", [](auto& r) -> auto& { return r.options.write.with_z; },
                              {.title = "Elevations in the vertices",
                               .help = "Write the threshold as the Z of every vertex.",
                               .python_name = "with_z"}));
    for (OptionRow& row : dataset())
        rows.push_back(std::move(row));
    for (OptionRow& row : also_written())
        rows.push_back(std::move(row));
    for (OptionRow& row : on_paper())
        rows.push_back(std::move(row));
    rows.push_back(polygons());
    return rows;
}

std::vector<OptionRow> report() {
    std::vector<OptionRow> rows;
    rows.push_back(sweep());
    rows.push_back(integer_row("threads", "<n>", {.lowest = 0, .highest = 1024},
                               [](auto& r) -> auto& { return r.options.run.threads; },
                               {.title = "Threads",
                                .help = "Number of threads; 0 takes one per core.",
                                .details = "The result does not depend on it."}));
    rows.push_back(
        switch_row("q", [](auto& r) -> auto& { return r.tool.quiet; },
                   {.title = "No progress", .help = "No progress and no summary.", .aliases = {"quiet"}}));
    rows.push_back(
        switch_row("json", [](auto& r) -> auto& { return r.tool.json; },
                   {.title = "Report as JSON",
                    .help = "Print a report of the run to stdout as JSON; implies -q.",
                    .details = "It holds counts, the reasons for everything that was dropped, warnings, and "
                               "seconds (of all threads together) and peak memory per stage."}));
    rows.push_back(switch_row("help", [](auto& r) -> auto& { return r.tool.help; },
                              {.title = "Help",
                               .everyday = true,
                               .help = "Print the everyday options and exit.",
                               .aliases = {"h"}}));
    rows.push_back(switch_row("help_all", [](auto& r) -> auto& { return r.tool.help_all; },
                              {.title = "All options",
                               .everyday = true,
                               .help = "Print all options and exit.",
                               .aliases = {"help-all"}}));
    rows.push_back(switch_row("version", [](auto& r) -> auto& { return r.tool.version; },
                              {.title = "Version", .help = "Print the version and exit."}));
    rows.push_back(switch_row("man", [](auto& r) -> auto& { return r.tool.man_page; },
                              {.help = "Print the man page and exit."}));
    rows.push_back(switch_row("options_md", [](auto& r) -> auto& { return r.tool.options_markdown; },
                              {.help = "Print the reference of the options in Markdown and exit."}));
    rows.push_back(switch_row("options_json", [](auto& r) -> auto& { return r.tool.options_json; },
                              {.help = "Print the table of options as JSON and exit."}));
    rows.push_back(switch_row("bash_completion", [](auto& r) -> auto& { return r.tool.bash_completion; },
                              {.help = "Print a script that completes command lines in Bash and exit."}));
    for (OptionRow& row : rows) {
        // Hidden, because programs use them to build, install or present the tool.
        row.hidden = row.name == "man" || row.name == "options_md" || row.name == "options_json" ||
                     row.name == "bash_completion";
        row.repeats = false;
        if (row.name != "threads")
            row.python = {};
    }
    return rows;
}

}  // namespace d2b::rows
