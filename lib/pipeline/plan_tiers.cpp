#include "pipeline/plan_tiers.hpp"

#include "core/stage_clock.hpp"
#include "levels/building_levels.hpp"
#include "levels/clean_tiers.hpp"

namespace d2b {
namespace {

/// Collects the elevation statistics from which each building's thresholds are derived.
void add_statistics(ElevationReader& reader, const FoundBuildings& found, BuildingStatistics& buildings,
                    Context& context) {
    reader.for_each(
        [&](const ElevationBand& band, Tally& tally) {
            const StageClock clock(tally, Stage::levels);
            return even_cells(band, found.band(band.shape));
        },
        [&](const ElevationBand&, const std::vector<EvenCells>& cells) {
            const StageClock clock(context.report, Stage::levels);
            buildings.add(cells);
        });
}

}  // namespace

Tiers plan_tiers(ElevationReader& reader, const FoundBuildings& found, const Window& window,
                 const RunSetup& setup, const FixedPoint& fixed, const LevelPlan& global, Context& context) {
    const RunPlan& decided = setup.plan;
    const double metres = context.report.units.vertical_metres;
    const RegionOptions regions = region_options(decided.detail, setup.cell, metres);
    Tiers tiers;
    BuildingStatistics statistics(found.count(), fixed, decided.levels == LevelSource::natural ? metres : 0);
    if (decided.detail > 0)
        tiers.clean.emplace(clean_tiers(
            reader, found.labels, found.count(), regions, window,
            [&](Label label, const BuildingCells& cells) { statistics.add(even_cells(cells, label)); },
            context));
    else
        add_statistics(reader, found, statistics, context);
    tiers.plan = plan_building_levels(statistics, found.ground, global, decided.asked.levels, decided.levels,
                                      metres, regions.price);
    return tiers;
}

}  // namespace d2b
