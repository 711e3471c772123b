#include "pipeline/plan_tiers.hpp"

#include "core/stage_clock.hpp"
#include "levels/building_levels.hpp"
#include "levels/clean_tiers.hpp"

namespace d2b {
namespace {

/// What the thresholds of each building depend on.
BuildingStatistics statistics_of(ElevationReader& reader, const FoundBuildings& found, const CleanRows* clean,
                                 BuildingStatistics buildings, Context& context) {
    reader.for_each(
        [&](const ElevationBand& band, Tally& tally) {
            const StageClock clock(tally, Stage::levels);
            const LabelBand labels = found.band(band.shape);
            return clean != nullptr ? even_cells(clean->clean(band), labels) : even_cells(band, labels);
        },
        [&](const ElevationBand&, const std::vector<EvenCells>& cells) {
            const StageClock clock(context.report, Stage::levels);
            buildings.add(cells);
        });
    return buildings;
}

}  // namespace

Tiers plan_tiers(ElevationReader& reader, const FoundBuildings& found, const Window& window,
                 const RunSetup& setup, const FixedPoint& fixed, const LevelPlan& global, Context& context) {
    const RunPlan& decided = setup.plan;
    const double metres = context.report.units.vertical_metres;
    const RegionOptions regions = region_options(decided.detail, setup.cell, metres);
    Tiers tiers;
    if (decided.detail > 0)
        tiers.clean = clean_tiers(reader, found.labels, found.count(), regions, window, context);
    const BuildingStatistics statistics = statistics_of(
        reader, found, tiers.clean ? &*tiers.clean : nullptr,
        BuildingStatistics(found.count(), fixed, decided.levels == LevelSource::natural ? metres : 0),
        context);
    tiers.plan = plan_building_levels(statistics, found.ground, global, decided.asked.levels, decided.levels,
                                      metres, regions.price);
    return tiers;
}

}  // namespace d2b
