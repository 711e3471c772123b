#include "pipeline/find_in_unit.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "core/equal_runs.hpp"
#include "core/row_bands.hpp"
#include "core/stage_clock.hpp"
#include "detect/detection.hpp"
#include "detect/ground_level.hpp"
#include "detect/label_rows.hpp"
#include "detect/side_grids.hpp"
#include "ground/ground.hpp"
#include "pipeline/scene_rasters.hpp"
#include "pipeline/seen_surface.hpp"

namespace d2b {
namespace {

Executor& threads_of(const UnitSearch& search) {
    return *search.context.threads;
}

/// Reads or estimates the terrain. Cells that the estimate finds far below the ground become NaN in the
/// surface.
MetreGrid terrain_of(const UnitSearch& search, const Window& seen, SeenSurface& seen_surface) {
    MetreGrid& surface = seen_surface.elevations();
    if (search.plan.ground == GroundMode::none)
        return MetreGrid(surface.rows, surface.cols, 0);
    if (search.plan.ground == GroundMode::given)
        return read_grid(*search.sources.terrain, seen, search.frame.metres, search.context);
    const StageClock clock(search.context.report, Stage::ground);
    Terrain terrain = estimate_ground(surface, search.frame.cell, search.plan.asked.ground, search.context,
                                      {seen.row, seen.col});
    // Cells far below the ground are measurement errors, neither building nor ground.
    seen_surface.take_out(terrain.flags, low_outlier, threads_of(search));
    return std::move(terrain.elevation);
}

/// Clamps a given terrain to the surface, because detection expects heights that are not negative.
void keep_below(const UnitSearch& search, const MetreGrid& surface, MetreGrid& terrain) {
    if (search.plan.ground != GroundMode::given)
        return;
    for_cells(threads_of(search), terrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (terrain.values[i] > surface.values[i])
                terrain.values[i] = surface.values[i];
    });
}

/// Returns the window of a unit's own cells within its extent.
Window own_in_seen(const Unit& unit) {
    return {unit.own.row - unit.seen.row, unit.own.col - unit.seen.col, unit.own.rows, unit.own.cols};
}

std::vector<SeenObject> seen_objects(const Detection& detection, const std::vector<double>& ground,
                                     const Window& own, Executor& threads) {
    std::vector<SeenObject> seen;
    for (std::size_t i = 0; i < detection.objects.size(); ++i)
        seen.push_back({detection.objects[i], i < detection.buildings, ground[i + 1], 0});
    for_row_bands(threads, own.rows, detection.labels.cols, [&](RowBand band) {
        for (std::int32_t r = own.row + band.begin; r < own.row + band.end; ++r)
            for_equal_runs(detection.labels.row(r).subspan(static_cast<std::size_t>(own.col),
                                                           static_cast<std::size_t>(own.cols)),
                           [&](std::int32_t begin, std::int32_t end, Label label) {
                               std::atomic_ref(seen[label - 1].own_cells)
                                   .fetch_add(end - begin, std::memory_order_relaxed);
                           });
    });
    return seen;
}

/// Counts rejected or cut-off objects whose first cell belongs to the unit, so that each is counted once.
void count_left_out(const LeftOut& left_out, const Window& own, RunReport& report) {
    const auto is_own = [&](const FirstCell& cell) {
        return cell.row >= own.row && cell.row < own.end_row() && cell.col >= own.col &&
               cell.col < own.end_col();
    };
    report.count(Reason::building_small, std::ranges::count_if(left_out.small, is_own));
    report.count(Reason::building_low, std::ranges::count_if(left_out.low, is_own));
    report.count(Reason::part_merged, std::ranges::count_if(left_out.parts, is_own));
    for (const CutCrown& crown : left_out.crowns)
        if (is_own(crown.first)) {
            report.count(Reason::crown_cut);
            report.count(Reason::crown_cells, crown.cells);
        }
}

}  // namespace

FoundInUnit find_in_unit(const UnitSearch& search, const Unit& unit) {
    const Options& options = search.plan.asked;
    const Sources& sources = search.sources;
    const UnitFrame& frame = search.frame;
    Context& context = search.context;
    Executor& threads = threads_of(search);
    const Window own = own_in_seen(unit);
    FoundInUnit found{{}, {}, GroundFit(options.detect.min_height), {}, {false, false, false}, {}, {}, {}};
    SeenSurface seen_surface(search.reader, unit.seen, frame.metres, threads);
    const MetreGrid& surface = seen_surface.elevations();
    if (search.plan.ground != GroundMode::given)
        add_islands(surface, frame.cell, own, search.plan.building_m2, options.ground.max_building_width,
                    found.islands, threads);
    MetreGrid terrain = terrain_of(search, unit.seen, seen_surface);
    add_fit(surface, terrain, own, found.fit, threads);
    add_slope(terrain, frame.cell, unit.seen.row - frame.window.row, own, found.slope, threads);
    found.sides.terrain = search.plan.ground != GroundMode::given || found.fit.cells() > 0;
    keep_below(search, surface, terrain);
    Mask allowed;
    MetreGrid ndvi;
    Scene scene{surface, terrain, frame.cell};
    if (sources.mask != nullptr) {
        allowed = read_mask(*sources.mask, unit.seen, context);
        scene.allowed = &allowed;
    }
    found.sides.mask = sources.mask == nullptr || meets(surface, allowed, own);
    if (sources.ndvi != nullptr) {
        ndvi = read_grid(*sources.ndvi, unit.seen, 1, context);
        scene.greenness = &ndvi;
    }
    ParcelGrid parcels;
    if (sources.parcels != nullptr) {
        parcels = ParcelGrid(surface.rows, surface.cols);
        sources.parcels->read(unit.seen, parcels.values);
        scene.parcels = &parcels;
    }
    found.sides.ndvi = sources.ndvi == nullptr || meets(surface, ndvi, own);
    Detection detection = [&] {
        const StageClock clock(context.report, Stage::detect);
        return detect_buildings(scene, options.detect, search.plan.building_m2, context);
    }();
    if (scene.parcels != nullptr)
        add_fit(scene, detection, own, found.parcels, threads);
    add_sampling(scene, detection, options.detect.min_height, own, found.sampling, threads);
    count_left_out(detection.left_out, own, context.report);
    write_scene_rasters(search.sinks, scene, detection, options.detect.min_height, unit);
    const StageClock clock(context.report, Stage::attributes);
    const std::vector<double> ground =
        ground_levels(terrain, detection.labels, static_cast<Label>(detection.objects.size()), threads);
    found.objects = seen_objects(detection, ground, own, threads);
    found.labels = std::move(detection.labels);
    return found;
}

}  // namespace d2b
