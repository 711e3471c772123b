#include <cstdint>
#include <utility>

#include "elevations/elevation_reader.hpp"
#include "pipeline/find_buildings.hpp"
#include "pipeline/report_run.hpp"
#include "pipeline/tiles/tile_footprints.hpp"
#include "pipeline/tiles/tile_rasters.hpp"
#include "pipeline/tiles/tile_steps.hpp"

namespace d2b::tiles {
namespace {

/// Reads the extent of a tile's units and filters invalid elevations. Reads one cell more on each side,
/// because spikes are judged by their eight neighbours.
ElevationSurvey survey(ElevationReader& reader, const TileRun& run, const Window& own, Context& context) {
    const Window& window = run.window();
    return reader.survey(
        run.validity_rules(),
        [&](const ElevationBand& band) {
            context.progress(0.3 * static_cast<double>(band.shape.first_row - window.row) / window.rows);
        },
        own);
}

/// @param by_layer of the footprints of the tile
std::vector<SeenGiven> seen_given(const std::vector<std::vector<detect::SeenFootprint>>& by_layer,
                                  const PlannedFootprints& given) {
    std::vector<SeenGiven> seen;
    for (std::size_t layer = 0; layer < by_layer.size(); ++layer)
        for (const detect::SeenFootprint& one : by_layer[layer])
            seen.push_back({given.indices[given.footprints.layers[layer].footprints[one.label]], one});
    return seen;
}

FoundUnit found_unit(const detect::Unit& unit, pipeline::FoundInUnit&& here, const PlannedFootprints& given) {
    return {std::move(here.objects), label_runs(unit, here.labels), detect::edges_of(unit, here.labels),
            seen_given(here.footprints, given)};
}

void find_units(TileRun& run, std::int64_t tile, SubwindowSource& part, ElevationReader& reader,
                FoundTile& found) {
    const Sources sources = with_dem(run.sources(), part);
    PlannedSink nowhere(run.setup().plan.layers);
    AuxiliarySinks rasters = open_tile_rasters(run, tile);
    PlannedFootprints given = load_planned_footprints(run, tile);
    const Sinks sinks{nowhere, rasters.ground.get(), rasters.height.get(), rasters.canopy.get()};
    const pipeline::UnitSearch search{run.setup().plan,
                                      sources,
                                      sinks,
                                      reader,
                                      {run.window(), run.setup().cell, run.metres()},
                                      run.context(),
                                      run.has_footprints() ? &given.footprints : nullptr};
    FoundFacts& facts = found.facts;
    for (const NumberedUnit& placed : run.tiles().units_of(tile)) {
        pipeline::FoundInUnit here = pipeline::find_in_unit(search, placed.unit);
        facts.scene.merge(here.scene);
        facts.effective.insert(here.effective.begin(), here.effective.end());
        found.units.push_back(found_unit(placed.unit, std::move(here), given));
    }
    finish_tile_rasters(run, tile, rasters);
    if (run.setup().plan.ground == GroundMode::given)
        facts.terrain_outside = run.sources().terrain->cells_outside_range();
}

}  // namespace

void find_tile(TileRun& run, std::int64_t tile) {
    const Checkpoint place = run.file(TileStep::find, tile);
    if (checkpoint_exists(place) && has_rasters(run, tile))
        return;
    Context& context = run.context();
    FoundTile found{run.empty_facts(), {}};
    const detect::Unit whole = run.tiles().whole(tile);
    SubwindowSource part(run.sources().dem, expanded(whole.seen, 1, 1, run.window()));
    ElevationReader reader(part, context);
    found.facts.survey = survey(reader, run, whole.own, context);
    find_units(run, tile, part, reader, found);
    found.facts.tally.merge(context.report);
    found.facts.warnings = pipeline::take_warnings(run.sources());
    ByteWriter writer;
    save(found, writer);
    write_checkpoint(place, writer.bytes());
}

}  // namespace d2b::tiles
