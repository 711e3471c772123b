#include "options/run_plan.hpp"

#include <algorithm>
#include <utility>

#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

/// Refuses options for layers that are not written because of the format. The table of rules covers layers
/// excluded by name.
void refuse_for_layers(const Options& options, Layers layers) {
    const WriteOptions& write = options.write;
    if (options.outline.disjoint && layers == Layers::buildings)
        throw OptionError(
            "-disjoint has no effect if only buildings are written; use -layers contours, or a format that "
            "holds both layers, such as GeoPackage.");
    if (write.fields != FieldNames::own && layers == Layers::contours && !write.doubtful)
        throw OptionError(
            "-fields has no effect if only contours are written; only fields of buildings have other names.");
}

}  // namespace

double detail_of(const Options& options) {
    return options.levels.detail.value_or(detects_buildings(options) ? default_detail_m : 0);
}

double RunPlan::wall_tolerance(double cell_m) const {
    if (asked.outline.wall_tolerance)
        return *asked.outline.wall_tolerance;
    return cell_m > 0 ? std::max(min_wall_tolerance_cells, wall_tolerance_m / cell_m)
                      : min_wall_tolerance_cells;
}

double RunPlan::wall_price(double cell_m) {
    return cell_m > 0 ? std::max(min_wall_price_cells, wall_price_m2 / (cell_m * cell_m))
                      : min_wall_price_cells;
}

Options RunPlan::resolved() const {
    Options options = asked;
    options.ground.mode = ground;
    options.levels.source = levels;
    options.levels.detail = detail;
    options.trace.mode = trace;
    options.outline.walls = walls;
    options.filter.min_area_m2 = detects_buildings() ? building_m2 : contour_m2;
    options.write.layers = layers;
    options.write.surface_of = surface_of;
    return options;
}

RunPlan make_run_plan(Options options, Layers layers) {
    refuse_for_layers(options, layers);
    const bool detects = detects_buildings(options);
    const bool straightens = detects && options.outline.simplify == 0;
    RunPlan plan{
        .asked = {},
        .ground = options.ground.mode.value_or(detects ? GroundMode::automatic : GroundMode::none),
        .levels = options.levels.source.value_or(detects ? LevelSource::natural : LevelSource::global),
        .detail = detail_of(options),
        .trace = options.trace.mode.value_or(detects ? TraceMode::cells : TraceMode::points),
        .walls = options.outline.walls.value_or(straightens ? Walls::automatic : Walls::off),
        .building_m2 = options.filter.min_area_m2.value_or(default_min_building_m2),
        .contour_m2 = detects ? 0 : options.filter.min_area_m2.value_or(0),  // tiers may be smaller
        .layers = layers,
        .surface_of =
            options.write.surface_of.value_or(detects ? SurfaceOf::buildings : SurfaceOf::contours)};
    plan.asked = std::move(options);
    return plan;
}

}  // namespace d2b
