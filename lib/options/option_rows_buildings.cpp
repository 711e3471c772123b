#include "options/option_rows.hpp"

namespace d2b::rows {
namespace {

OptionRow preset() {
    const Choices<std::string> presets{{"buildings", "buildings"}, {"thesis", "thesis"}};
    return choice_row(
        "preset", "buildings|thesis", presets, [](auto& r) -> auto& { return r.options.preset; },
        {.help = "Method, with its defaults; the other options refine it.",
         .details =
             "buildings: ground and buildings are found in the input, outlines get straight walls, and "
             "contours "
             "divide each building by height. thesis is the method of Chittineni (2003): thresholds from the "
             "mean and the standard deviation of all elevations, and collapsed contouring; everything above "
             "the lowest threshold is taken for a building, trees too."});
}

/// "auto", "none" or the name of a terrain model.
OptionRow ground() {
    OptionRow row = described(
        "ground", "auto|none|<terrain model>",
        {.help = "The ground under the buildings.",
         .details =
             "auto: it is estimated from the input. none: the input holds heights above ground. A terrain "
             "model "
             "is any raster that GDAL reads; it is brought to the cells, CRS and unit of the input. A file "
             "called auto or none needs its path: ./auto."});
    row.apply = [](Request& request, OptionValues texts) {
        GroundOptions& ground = request.options.ground;
        ground.mode = texts[0] == "auto"   ? GroundMode::automatic
                      : texts[0] == "none" ? GroundMode::none
                                           : GroundMode::given;
        ground.terrain = ground.mode == GroundMode::given ? texts[0] : "";
    };
    row.show = [](const Request& request) {
        switch (request.options.ground.mode) {
            case GroundMode::given:
                return request.options.ground.terrain;
            case GroundMode::none:
                return std::string("none");
            case GroundMode::automatic:
                return std::string("auto");
            case GroundMode::by_preset:
                break;
        }
        return std::string();
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
                                          "size of the smooth pieces."}));
    rows.push_back(text_row(
        "mask", "<raster or polygons>", [](auto& r) -> auto& { return r.options.detect.mask; },
        {.help = "Look for buildings only where this raster is not 0, or in these polygons.",
         .details = "Any dataset that GDAL reads, in any CRS. The ground is estimated everywhere."}));
    rows.push_back(
        text_row("mask_layer", "<layer>", [](auto& r) -> auto& { return r.options.detect.mask_layer; },
                 {.help = "Layer of the polygons of -mask; by default the first that has geometries."}));
    rows.push_back(
        text_row("ndvi", "<raster>", [](auto& r) -> auto& { return r.options.detect.ndvi; },
                 {.help = "Vegetation index from -1 to 1, which helps to tell trees from buildings.",
                  .details = "Values above 0.3 are taken for plants."}));
    rows.push_back(number_row(
        "split_height", "<m>", {.lowest = 0}, [](auto& r) -> auto& { return r.options.detect.split_height; },
        {.help = "Divide buildings where the height steps by more; 0 divides none.",
         .details = "The parts share their wall exactly. Parts that are smaller than -min_area "
                    "stay with their neighbour.",
         .unit = "m"}));
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
                    .unit = "m"}));
    rows.push_back(number_row(
        "min_height", "<m>", {.lowest = 0}, [](auto& r) -> auto& { return r.options.detect.min_height; },
        {.help = "Lowest height above ground that belongs to a building.", .unit = "m"}));
    for (OptionRow& row : evidence())
        rows.push_back(std::move(row));
    return rows;
}

}  // namespace d2b::rows
