#include "pipeline/trace_contours.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "contours/building_levels.hpp"
#include "detect/detection.hpp"

namespace d2b::pipeline {
namespace {

/// Collects the elevation statistics from which each building's thresholds are derived.
void add_statistics(ElevationReader& reader, const FoundBuildings& found,
                    contours::BuildingStatistics& buildings, Context& context) {
    reader.for_each(
        [&](const ElevationBand& band, Tally& tally) {
            const StageClock clock(tally, Stage::levels);
            return contours::constant_runs(band, found.band(band.shape));
        },
        [&](const ElevationBand&, const std::vector<contours::ConstantRun>& cells) {
            const StageClock clock(context.report, Stage::levels);
            buildings.add(cells);
        });
}

struct BandTracing {
    const contours::TraceFrame& frame;
    const Tiers& tiers;
    const FoundBuildings* found;  ///< null if all points bear one label
    TraceMode mode;
};

LabelBand labels_of(const ElevationBand& band, const BandTracing& tracing) {
    Context none;
    const FoundBuildings* found = tracing.found;
    return found == nullptr ? detect::detect_one_label(band, none) : found->band(band.shape);
}

/// Overwrites the levels of building cells by those of their simplified elevations.
template <typename Count>
void take_clean_levels(const contours::CleanRows& clean, const LabelBand& labels,
                       const contours::LevelPlan& plan, LevelBand<Count>& levels) {
    clean.for_runs(levels.shape, [&](const contours::CleanRows::CleanRun& run) {
        const auto begin = static_cast<std::size_t>(run.begin);
        const auto count = contours::quantise<Count>(run.elevation, labels.row(run.row)[begin], plan);
        const std::size_t row =
            static_cast<std::size_t>(run.row) * static_cast<std::size_t>(levels.shape.cols);
        std::fill_n(levels.counts.data() + (row + begin), run.end - run.begin, count);
    });
}

template <typename Count>
contours::PointRows<Count> point_rows(const std::shared_ptr<const ElevationBand>& elevations,
                                      const BandTracing& tracing) {
    contours::PointRows<Count> rows;
    rows.labels = labels_of(*elevations, tracing);
    rows.levels = contours::quantise<Count>(*elevations, rows.labels, tracing.tiers.plan);
    if (tracing.tiers.clean)
        take_clean_levels(*tracing.tiers.clean, rows.labels, tracing.tiers.plan, rows.levels);
    rows.elevations = elevations;
    return rows;
}

/// Band traced as far as possible without the bands above it.
struct TracedBand {
    contours::ContourBatch contours;  ///< contours that lie entirely in the band
    contours::LinkedBand linked;
};

/// Traces all bands, of which each repeats the rows above it that it depends on. The tracer's memory is
/// released at the end.
template <typename Count>
void trace_into(contours::ContourArchive& store, ElevationReader& reader, const BandTracing& tracing,
                Context& context) {
    const contours::TraceFrame& frame = tracing.frame;
    contours::Tracer tracer(frame, tracing.mode, store);
    reader.for_each_with_halo(
        contours::rows_above(tracing.mode),
        [&](ElevationBand above, const ElevationBand& elevations, Tally& tally) {
            contours::PointRows<Count> before;
            contours::PointRows<Count> band;
            {
                const StageClock clock(tally, Stage::levels);
                before = point_rows<Count>(std::make_shared<ElevationBand>(std::move(above)), tracing);
                const std::shared_ptr<const ElevationBand> borrowed(std::shared_ptr<void>(), &elevations);
                band = point_rows<Count>(borrowed, tracing);
            }
            const StageClock clock(tally, Stage::trace);
            TracedBand traced;
            contours::ContourWriter batch_writer = store.batch_writer(traced.contours, tally);
            traced.linked = contours::Tracer::link(
                frame, tracing.mode, contours::split_into_runs(frame, tracing.mode, before, band),
                batch_writer);
            return traced;
        },
        [&](const ElevationBand& band, TracedBand traced) {
            {
                const StageClock clock(context.report, Stage::trace);
                tracer.join(std::move(traced.linked), store.add(std::move(traced.contours)));
            }
            context.progress(static_cast<double>(band.shape.first_row + band.shape.rows - frame.window.row) /
                             frame.window.rows);
        });
}

contours::ContourArchive contour_store(const contours::TraceFrame& frame, const FoundBuildings* found,
                                       const features::RunSetup& setup, Context& context) {
    const RunPlan& plan = setup.plan;
    const contours::NoiseRules noise{plan.asked.filter.noise_factor, plan.contour_m2,
                                     plan.detects_buildings()};
    // Detected footprints do not stand on other contours.
    contours::HeightRules heights;
    if (found != nullptr)
        heights = {plan.asked.detect.min_building_height, found->ground,
                   context.report.units.vertical_metres};
    return {
        {noise, setup.area, frame.range, frame.fixed, found == nullptr, plan.asked.write.rejected, heights},
        context.make_spool(),
        context};
}

}  // namespace

Tiers plan_tiers(ElevationReader& reader, const FoundBuildings& found, const Window& window,
                 const features::RunSetup& setup, const FixedPoint& fixed, const contours::LevelPlan& global,
                 Context& context) {
    const RunPlan& decided = setup.plan;
    const double metres = context.report.units.vertical_metres;
    const contours::RegionOptions regions = contours::region_options(decided.detail, setup.cell, metres);
    Tiers tiers;
    contours::BuildingStatistics statistics(found.count(), fixed,
                                            decided.levels == LevelSource::natural ? metres : 0);
    if (decided.detail > 0)
        tiers.clean.emplace(contours::clean_tiers(
            reader, found.labels, found.count(), regions, window,
            [&](Label label, const contours::BuildingCells& cells) {
                statistics.add(contours::constant_runs(cells, label));
            },
            context));
    else
        add_statistics(reader, found, statistics, context);
    tiers.plan = contours::plan_building_levels(statistics, found.ground, global, decided.asked.levels,
                                                decided.levels, metres, regions.price);
    return tiers;
}

std::unique_ptr<contours::StoredContours> trace_contours(ElevationReader& reader,
                                                         const contours::TraceFrame& frame,
                                                         const Tiers& tiers, const FoundBuildings* found,
                                                         const features::RunSetup& setup, Context& context) {
    contours::ContourArchive store = contour_store(frame, found, setup, context);
    const BandTracing tracing{frame, tiers, found, setup.plan.trace};
    if (tiers.plan.level_count() <= std::numeric_limits<std::uint8_t>::max())
        trace_into<std::uint8_t>(store, reader, tracing, context);
    else
        trace_into<std::uint16_t>(store, reader, tracing, context);
    const StageClock clock(context.report, Stage::filter);
    return store.finish();
}

}  // namespace d2b::pipeline
