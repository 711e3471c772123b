#include "options/option_rows.hpp"

namespace d2b::rows {
namespace {

OptionRow preset() {
    Choices<Preset> presets;
    for (const Preset preset : every_preset)
        presets.emplace_back(preset_name(preset), preset);
    return choice_row(
        "preset", presets, [](auto& r) -> auto& { return r.options.preset; },
        {.title = "Method",
         .help = "Method, with its defaults; the other options refine it.",
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
        {.title = "Where the ground comes from",
         .section = DialogSection::ground,
         .help = "The ground under the buildings.",
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
                              {.title = "Least confidence",
                               .section = DialogSection::trees,
                               .help = "Objects of less confidence are not taken for buildings.",
                               .details = "Confidence tells buildings from trees by smoothness, the step "
                                          "along the border, and the tilt and "
                                          "size of the smooth pieces.",
                               .scope = where_buildings_are_found(),
                               .item = "MIN_CONFIDENCE"}));
    rows.push_back(
        text_row("mask", OptionKind::dataset, "<raster or polygons>",
                 [](auto& r) -> auto& { return r.options.detect.mask; },
                 {.title = "Where buildings may stand",
                  .section = DialogSection::trees,
                  .help = "Look for buildings only where this raster is not 0, or in these polygons.",
                  .details = "Any dataset that GDAL reads, in any CRS. The ground is estimated everywhere.",
                  .scope = where_buildings_are_found(),
                  .item = "MASK"}));
    rows.push_back(
        text_row("mask_layer", OptionKind::text, "<layer>",
                 [](auto& r) -> auto& { return r.options.detect.mask_layer; },
                 {.title = "Layer of where buildings may stand",
                  .help = "Layer of the polygons of -mask; by default the first that has geometries.",
                  .scope = where_buildings_are_found()}));
    rows.push_back(text_row(
        "ndvi", OptionKind::raster, "<raster>", [](auto& r) -> auto& { return r.options.detect.ndvi; },
        {.title = "Vegetation index (NDVI)",
         .section = DialogSection::trees,
         .help = "Vegetation index from -1 to 1, which helps to tell trees from buildings.",
         .details = "Values above 0.3 are taken for plants.",
         .scope = where_buildings_are_found(),
         .item = "NDVI"}));
    rows.push_back(number_row(
        "split_height", "<m>", {.lowest = 0}, [](auto& r) -> auto& { return r.options.detect.split_height; },
        {.title = "Step of the height that divides a building",
         .section = DialogSection::detail,
         .help = "Divide buildings where the height steps by more; 0 divides none. Houses of equal height "
                 "that share walls stay one block.",
         .details = "A layer of plots divides such a block, for example by Intersection in QGIS. "
                    "The parts share their wall exactly. Parts that are smaller than -min_area "
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
                   {.title = "Widest building",
                    .section = DialogSection::ground,
                    .help = "Widest building: ground is looked for at this distance.",
                    .details = "For -ground auto. More time and coarser ground on hills with larger ones.",
                    .unit = "m",
                    .scope = where_buildings_are_found(),
                    .item = "MAX_BUILDING_WIDTH_M"}));
    rows.push_back(number_row("min_height", "<m>", {.lowest = 0},
                              [](auto& r) -> auto& { return r.options.detect.min_height; },
                              {.title = "Height above the ground where a building begins",
                               .section = DialogSection::ground,
                               .help = "Lowest height above ground that belongs to a building.",
                               .unit = "m",
                               .scope = where_buildings_are_found(),
                               .item = "MIN_HEIGHT_M"}));
    rows.push_back(number_row(
        "min_building_height", "<m>", {.lowest = 0},
        [](auto& r) -> auto& { return r.options.detect.min_building_height; },
        {.title = "Lowest building to keep",
         .section = DialogSection::basic,
         .help = "Lowest building to keep, by its p90; 0 keeps all.",
         .details = "p90 is the height above ground that 90 % of its points do not exceed. What is kept is "
                    "kept whole, with its contours.",
         .unit = "m",
         .scope = where_buildings_are_found("0"),
         .item = "MIN_BUILDING_HEIGHT_M"}));
    for (OptionRow& row : evidence())
        rows.push_back(std::move(row));
    return rows;
}

}  // namespace d2b::rows
