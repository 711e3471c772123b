#include "options/option_rows.hpp"

namespace d2b::rows {
namespace {

OptionRow preset() {
    Choices<Preset> presets;
    for (const Preset preset : every_preset)
        presets.emplace_back(preset_name(preset), preset);
    return choice_row(
        "preset", presets, [](auto& r) -> auto& { return r.options.preset; },
        {.help = "Method, with its defaults; the other options refine it.",
         .details =
             "buildings: ground and buildings are found in the input, outlines get straight walls, and "
             "contours "
             "divide each building by height. thesis is the method of Chittineni (2003): thresholds from the "
             "mean and the standard deviation of all elevations, and collapsed contouring; everything above "
             "the lowest threshold is taken for a building, trees too.",
         .item = "PRESET"});
}

/// "auto", "none" or the name of a terrain model.
OptionRow ground() {
    const Choices<GroundMode> modes{{"auto", GroundMode::automatic}, {"none", GroundMode::none}};
    OptionRow row = described(
        "ground", OptionKind::terrain, joined(words_of(modes), "|") + "|<terrain model>",
        {.help = "The ground under the buildings.",
         .details =
             "auto: it is estimated from the input. none: the input holds heights above ground. A terrain "
             "model "
             "is any raster that GDAL reads; it is brought to the cells, CRS and unit of the input. A file "
             "called auto or none needs its path: ./auto.",
         .scope = where_buildings_are_found("none"),
         .item = "GROUND"});
    row.choices = words_of(modes);
    row.apply = [modes](Request& request, OptionValues texts) {
        GroundOptions& ground = request.options.ground;
        const std::optional<GroundMode> mode = choice_of(modes, texts[0]);
        ground.mode = mode.value_or(GroundMode::given);
        ground.terrain = mode ? "" : texts[0];
    };
    row.texts = [modes](const Request& request) {
        const GroundOptions& ground = request.options.ground;
        return ground.mode == GroundMode::given ? Texts{ground.terrain} : word_for(modes, ground.mode);
    };
    return row;
}

std::vector<OptionRow> evidence() {
    std::vector<OptionRow> rows;
    rows.push_back(number_row("min_confidence", "<0 to 1>", {.lowest = 0, .highest = 1},
                              [](auto& r) -> auto& { return r.options.detect.min_confidence; },
                              {.help = "Objects of less confidence are not taken for buildings.",
                               .details = "Confidence tells buildings from trees by smoothness, the step "
                                          "along the border, and the tilt and "
                                          "size of the smooth pieces.",
                               .scope = where_buildings_are_found(),
                               .item = "MIN_CONFIDENCE"}));
    rows.push_back(
        text_row("mask", OptionKind::dataset, "<raster or polygons>",
                 [](auto& r) -> auto& { return r.options.detect.mask; },
                 {.help = "Look for buildings only where this raster is not 0, or in these polygons.",
                  .details = "Any dataset that GDAL reads, in any CRS. The ground is estimated everywhere.",
                  .scope = where_buildings_are_found(),
                  .item = "MASK"}));
    rows.push_back(
        text_row("mask_layer", OptionKind::text, "<layer>",
                 [](auto& r) -> auto& { return r.options.detect.mask_layer; },
                 {.help = "Layer of the polygons of -mask; by default the first that has geometries.",
                  .scope = where_buildings_are_found()}));
    rows.push_back(text_row(
        "ndvi", OptionKind::raster, "<raster>", [](auto& r) -> auto& { return r.options.detect.ndvi; },
        {.help = "Vegetation index from -1 to 1, which helps to tell trees from buildings.",
         .details = "Values above 0.3 are taken for plants.",
         .scope = where_buildings_are_found(),
         .item = "NDVI"}));
    rows.push_back(number_row(
        "split_height", "<m>", {.lowest = 0}, [](auto& r) -> auto& { return r.options.detect.split_height; },
        {.help = "Divide buildings where the height steps by more; 0 divides none.",
         .details = "The parts share their wall exactly. Parts that are smaller than -min_area "
                    "stay with their neighbour.",
         .unit = "m",
         .scope = where_buildings_are_found("0"),
         .item = "SPLIT_HEIGHT_M"}));
    return rows;
}

}  // namespace

std::vector<OptionRow> buildings() {
    std::vector<OptionRow> rows;
    rows.push_back(preset());
    rows.push_back(ground());
    rows.push_back(
        number_row("max_building_width", "<m>", {.lowest = 0, .highest = 100000, .above_lowest = true},
                   [](auto& r) -> auto& { return r.options.ground.max_building_width; },
                   {.help = "Widest building: ground is looked for at this distance.",
                    .details = "For -ground auto. More time and coarser ground on hills with larger ones.",
                    .unit = "m",
                    .scope = where_buildings_are_found(),
                    .item = "MAX_BUILDING_WIDTH_M"}));
    rows.push_back(number_row("min_height", "<m>", {.lowest = 0},
                              [](auto& r) -> auto& { return r.options.detect.min_height; },
                              {.help = "Lowest height above ground that belongs to a building.",
                               .unit = "m",
                               .scope = where_buildings_are_found(),
                               .item = "MIN_HEIGHT_M"}));
    for (OptionRow& row : evidence())
        rows.push_back(std::move(row));
    return rows;
}

}  // namespace d2b::rows
