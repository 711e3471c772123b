#include "options/option_rows.hpp"
#include "options/run_plan.hpp"

namespace d2b::rows {
namespace {

OptionRow preset() {
    Choices<Preset> presets;
    for (const Preset preset : every_preset)
        presets.emplace_back(preset_name(preset), preset);
    return choice_row("preset", presets, [](auto& r) -> auto& { return r.options.preset; },
                      {.title = "Method",
                       .help = "Method: a set of defaults that other options refine.",
                       .details = "buildings finds the ground and the buildings, draws straight walls, and "
                                  "divides each building by height. thesis follows Chittineni (2003): "
                                  "everything above the lowest threshold is a building, trees too.",
                       .choice_titles = {"Find buildings", "All above thresholds (thesis)"},
                       .item = "PRESET"});
}

/// Takes "auto", "none" or the name of a terrain model.
OptionRow ground() {
    const Choices<GroundMode> modes{{"auto", GroundMode::automatic}, {"none", GroundMode::none}};
    OptionRow row = make_row(
        "ground", OptionKind::terrain, joined(words_of(modes), "|") + "|<terrain model>",
        {.title = "How the ground is found",
         .section = DialogSection::basic,
         .everyday = true,
         .help = "The ground below the buildings.",
         .details = "auto: estimated from the input. none: the input holds heights above ground. A terrain "
                    "model can be in any CRS and unit. A file called auto or none needs its path: ./auto.",
         .choice_titles = {"Estimate it from the raster", "The raster holds heights above ground"},
         .scope = detection_scope("none"),
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

std::vector<OptionRow> footprints() {
    std::vector<OptionRow> rows;
    rows.push_back(text_row("footprints", OptionKind::polygons, "<polygons>",
                            [](auto& r) -> auto& { return r.options.write.footprints; },
                            {.title = "Footprints that get heights",
                             .section = DialogSection::detail,
                             .everyday = true,
                             .help = "Give heights to footprints that exist, instead of outlining buildings.",
                             .details = "In any CRS. They come back as they are, with their own fields, and "
                                        "buildings found without a footprint go to the layer missing.",
                             .scope = detection_scope(),
                             .item = "FOOTPRINTS"}));
    rows.push_back(text_row("footprints_layer", OptionKind::text, "<layer>",
                            [](auto& r) -> auto& { return r.options.write.footprints_layer; },
                            {.title = "Layer of the footprints",
                             .help = "Layer of -footprints; by default the first with geometries.",
                             .scope = detection_scope()}));
    return rows;
}

std::vector<OptionRow> parcels() {
    std::vector<OptionRow> rows;
    rows.push_back(text_row("split_by", OptionKind::polygons, "<polygons or lines>",
                            [](auto& r) -> auto& { return r.options.detect.split_by; },
                            {.title = "Parcels that cut blocks into houses",
                             .section = DialogSection::detail,
                             .everyday = true,
                             .help = "Cut buildings by parcels: polygons, or lines that cross them.",
                             .details = "In any CRS. Each part is a building, parts share their walls "
                                        "exactly, and the field parcel identifies the polygon.",
                             .scope = detection_scope(),
                             .item = "SPLIT_BY"}));
    rows.push_back(text_row("split_layer", OptionKind::text, "<layer>",
                            [](auto& r) -> auto& { return r.options.detect.split_layer; },
                            {.title = "Layer of the parcels",
                             .help = "Layer of -split_by; by default the first with geometries.",
                             .scope = detection_scope()}));
    rows.push_back(
        text_row("split_field", OptionKind::text, "<field>",
                 [](auto& r) -> auto& { return r.options.detect.split_field; },
                 {.title = "Field that identifies a parcel",
                  .help = "Field of -split_by that identifies a parcel; by default the feature id.",
                  .scope = detection_scope()}));
    rows.push_back(number_row(
        "split_width", "<m>", {.lowest = 0}, [](auto& r) -> auto& { return r.options.detect.split_width; },
        {.title = "Narrowest part that parcels cut off",
         .help = "Narrowest part that -split_by cuts off; a cut closer to a wall follows the wall.",
         .details = "Narrower parts stay with their neighbour. Parts smaller than -min_area join the "
                    "neighbour with the longest shared wall.",
         .unit = "m",
         .scope = detection_scope(),
         .item = "SPLIT_WIDTH_M"}));
    return rows;
}

std::vector<OptionRow> exclusion() {
    std::vector<OptionRow> rows;
    rows.push_back(
        text_row("exclude", OptionKind::polygons, "<polygons>",
                 [](auto& r) -> auto& { return r.options.detect.exclude; },
                 {.title = "Polygons of objects that are not buildings",
                  .section = DialogSection::detail,
                  .help = "Leave out objects of which half lies in these polygons, such as bridges.",
                  .details = "In any CRS: bridges, water, ships, tanks. The number is reported. "
                             "Beside -footprints it concerns the layer missing alone.",
                  .scope = detection_scope(),
                  .item = "EXCLUDE"}));
    rows.push_back(text_row("exclude_layer", OptionKind::text, "<layer>",
                            [](auto& r) -> auto& { return r.options.detect.exclude_layer; },
                            {.title = "Layer of objects that are not buildings",
                             .help = "Layer of -exclude; by default the first with geometries.",
                             .scope = detection_scope()}));
    rows.push_back(number_row("exclude_buffer", "<m>", {.lowest = 0},
                              [](auto& r) -> auto& { return r.options.detect.exclude_buffer; },
                              {.title = "Margin around objects that are not buildings",
                               .help = "Widen the polygons of -exclude on all sides.",
                               .details = "For polygons that are drawn inside the edges of the object.",
                               .unit = "m",
                               .scope = detection_scope(),
                               .item = "EXCLUDE_BUFFER_M"}));
    return rows;
}

std::vector<OptionRow> corrections() {
    std::vector<OptionRow> rows;
    rows.push_back(
        text_row("corrections", OptionKind::polygons, "<points, polygons and lines>",
                 [](auto& r) -> auto& { return r.options.detect.corrections; },
                 {.title = "Corrections of an editor",
                  .section = DialogSection::detail,
                  .help = "Obey an editor's decisions: buildings, objects that are not buildings, and cuts.",
                  .details = "The field kind is 'building', 'no building' (points or polygons) or "
                             "'cut' (lines). In any CRS. Corrections without effect are named. "
                             "Beside -footprints they concern the layer missing alone.",
                  .scope = detection_scope(),
                  .item = "CORRECTIONS"}));
    rows.push_back(text_row("corrections_layer", OptionKind::text, "<layer>",
                            [](auto& r) -> auto& { return r.options.detect.corrections_layer; },
                            {.title = "Layer of the corrections",
                             .help = "Layer of -corrections; by default all that have a field kind.",
                             .scope = detection_scope()}));
    return rows;
}

std::vector<OptionRow> evidence() {
    std::vector<OptionRow> rows;
    rows.push_back(
        number_row("min_confidence", "<0 to 1>", {.lowest = 0, .highest = 1},
                   [](auto& r) -> auto& { return r.options.detect.min_confidence; },
                   {.title = "Minimum confidence of a building, 0 to 1",
                    .section = DialogSection::basic,
                    .everyday = true,
                    .help = "Minimum confidence of a building; less certain objects are left out.",
                    .details = "Confidence separates buildings from trees by smoothness, edges and shape.",
                    .scope = detection_scope(),
                    .item = "MIN_CONFIDENCE"}));
    rows.push_back(
        text_row("mask", OptionKind::dataset, "<raster or polygons>",
                 [](auto& r) -> auto& { return r.options.detect.mask; },
                 {.title = "Where buildings may stand (mask)",
                  .section = DialogSection::trees,
                  .help = "Look for buildings only where this raster is not 0, or in these polygons.",
                  .details = "In any CRS. The ground is estimated everywhere.",
                  .scope = detection_scope(),
                  .item = "MASK"}));
    rows.push_back(text_row("mask_layer", OptionKind::text, "<layer>",
                            [](auto& r) -> auto& { return r.options.detect.mask_layer; },
                            {.title = "Layer of the mask",
                             .help = "Layer of -mask; by default the first with geometries.",
                             .scope = detection_scope()}));
    for (OptionRow& row : exclusion())
        rows.push_back(std::move(row));
    for (OptionRow& row : corrections())
        rows.push_back(std::move(row));
    rows.push_back(text_row("ndvi", OptionKind::raster, "<raster>",
                            [](auto& r) -> auto& { return r.options.detect.ndvi; },
                            {.title = "Vegetation index (NDVI)",
                             .section = DialogSection::trees,
                             .help = "Vegetation index (NDVI) from -1 to 1, to tell trees from buildings.",
                             .details = "Values above 0.3 are plants.",
                             .scope = detection_scope(),
                             .item = "NDVI"}));
    rows.push_back(number_row(
        "split_height", "<m>", {.lowest = 0}, [](auto& r) -> auto& { return r.options.detect.split_height; },
        {.title = "Divide buildings at height steps above (0: never)",
         .section = DialogSection::basic,
         .everyday = true,
         .help = "Divide buildings at height steps larger than this; 0 divides none.",
         .details = "The parts share their walls exactly; parts smaller than -min_area stay with their "
                    "neighbour. Houses of equal height stay one block; -split_by divides them.",
         .unit = "m",
         .scope = detection_scope("0"),
         .item = "SPLIT_HEIGHT_M"}));
    for (OptionRow& row : parcels())
        rows.push_back(std::move(row));
    for (OptionRow& row : footprints())
        rows.push_back(std::move(row));
    return rows;
}

}  // namespace

std::vector<OptionRow> buildings() {
    std::vector<OptionRow> rows;
    rows.push_back(preset());
    rows.push_back(ground());
    rows.push_back(number_row(
        "max_building_width", "<m>", {.lowest = 0, .highest = 100000, .above_lowest = true},
        [](auto& r) -> auto& { return r.options.ground.max_building_width; },
        {.title = "Widest building",
         .section = DialogSection::ground,
         .help = "Width of the widest building; ground is searched within this distance.",
         .details = "For -ground auto. A larger width takes longer and follows hills less closely.",
         .unit = "m",
         .scope = detection_scope(),
         .item = "MAX_BUILDING_WIDTH_M"}));
    rows.push_back(number_row(
        "min_height", "<m>", {.lowest = 0}, [](auto& r) -> auto& { return r.options.detect.min_height; },
        {.title = "Height above ground at which a building begins",
         .section = DialogSection::ground,
         .help = "Lowest height above ground that belongs to a building.",
         .details =
             "Lower parts of buildings are cut off; to keep only tall buildings use -min_building_height.",
         .unit = "m",
         .scope = detection_scope(),
         .item = "MIN_HEIGHT_M"}));
    rows.push_back(number_row("min_building_height", "<m>", {.lowest = 0},
                              [](auto& r) -> auto& { return r.options.detect.min_building_height; },
                              {.title = "Minimum height of a building",
                               .section = DialogSection::basic,
                               .help = "Lowest building to keep, by its p90; 0 keeps all.",
                               .details = "p90 is the height above ground that 90 % of its points do not "
                                          "exceed. Buildings are kept whole.",
                               .unit = "m",
                               .scope = detection_scope("0"),
                               .item = "MIN_BUILDING_HEIGHT_M"}));
    rows.push_back(number_row(
        "min_area", "<m2>", {.lowest = 0}, [](auto& r) -> auto& { return r.options.filter.min_area_m2; },
        {.title = "Minimum area of a building",
         .section = DialogSection::basic,
         .everyday = true,
         .help = "Smallest area of a building; by default " + number_text(default_min_building_m2) + " m2.",
         .details =
             "With -preset thesis, which has no default, it drops smaller contours and fills smaller holes.",
         .unit = "m2",
         .item = "MIN_AREA_M2"}));
    for (OptionRow& row : evidence())
        rows.push_back(std::move(row));
    return rows;
}

}  // namespace d2b::rows
