#include <utility>

#include "elevations/part_source.hpp"
#include "pipeline/find_in_unit.hpp"
#include "pipeline/tiles/tile_steps.hpp"

namespace d2b {
namespace {

/// Reads what a tile's units see, and finds out what of it is no elevation, for which a cell more is looked
/// at.
ElevationSurvey survey(ElevationReader& reader, const TileRun& run, const Window& own, Context& context) {
    const Window& window = run.window();
    return reader.survey(
        run.sift_rules(),
        [&](const ElevationBand& band) {
            context.progress(0.3 * static_cast<double>(band.shape.first_row - window.row) / window.rows);
        },
        own);
}

FoundUnit found_unit(const Unit& unit, FoundInUnit&& here) {
    std::vector<LabelRun> runs = label_runs(unit, here.labels);
    std::vector<Window> boxes = boxes_of(here.objects.size(), runs);
    return {std::move(here.objects), std::move(boxes), std::move(runs), edges_of(unit, here.labels)};
}

}  // namespace

void find_tile(TileRun& run, std::int64_t tile) {
    const auto path = run.file(TileStep::find, tile);
    const Seal seal = run.seal(TileStep::find, tile);
    if (is_sealed(path, seal))
        return;
    Context& context = run.context();
    const Unit whole = run.tiles().whole(tile);
    PartSource part(run.sources().dem, grown(whole.seen, 1, 1, run.window()));
    ElevationReader reader(part, context);
    FoundTile found{run.no_facts(), {}};
    FoundFacts& facts = found.facts;
    facts.survey = survey(reader, run, whole.own, context);
    const Sources sources{part, run.sources().terrain, run.sources().mask, run.sources().ndvi};
    PlannedSink nowhere(run.setup().plan.layers);
    const Sinks sinks{nowhere};
    const UnitSearch search{
        run.setup().plan, sources, sinks, reader, {run.window(), run.setup().cell, run.metres()}, context};
    for (const PlacedUnit& placed : run.tiles().units_of(tile)) {
        FoundInUnit here = find_in_unit(search, placed.unit);
        facts.fit.merge(here.fit);
        facts.slope.merge(here.slope);
        facts.sides.merge(here.sides);
        found.units.push_back(found_unit(placed.unit, std::move(here)));
    }
    facts.tally.merge(context.report);
    facts.warnings = run.sources().dem.take_warnings();
    ByteWriter writer;
    save(found, writer);
    write_sealed(path, seal, writer.bytes());
}

}  // namespace d2b
