#include "pipeline/trace_contours.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "contours/building_levels.hpp"
#include "contours/clean_tiers.hpp"
#include "contours/level_plan.hpp"
#include "core/context.hpp"
#include "detect/detection.hpp"

namespace d2b {
namespace {

/// Collects the elevation statistics from which each building's thresholds are derived.
void add_statistics(ElevationReader& reader, const FoundBuildings& found, BuildingStatistics& buildings,
                    Context& context) {
    reader.for_each(
        [&](const ElevationBand& band, Tally& tally) {
            const StageClock clock(tally, Stage::levels);
            return constant_runs(band, found.band(band.shape));
        },
        [&](const ElevationBand&, const std::vector<ConstantRun>& cells) {
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
            [&](Label label, const BuildingCells& cells) { statistics.add(constant_runs(cells, label)); },
            context));
    else
        add_statistics(reader, found, statistics, context);
    tiers.plan = plan_building_levels(statistics, found.ground, global, decided.asked.levels, decided.levels,
                                      metres, regions.price);
    return tiers;
}

namespace {

LabelBand labels_of(const ElevationBand& band, const BandTracing& tracing) {
    Context none;
    const FoundBuildings* found = tracing.image.found;
    return found == nullptr ? detect_one_label(band, none) : found->band(band.shape);
}

/// Overwrites the levels of building cells by those of their simplified elevations.
template <typename Count>
void take_clean_levels(const CleanRows& clean, const LabelBand& labels, const LevelPlan& plan,
                       LevelBand<Count>& levels) {
    clean.for_runs(levels.shape, [&](const CleanRows::CleanRun& run) {
        const auto begin = static_cast<std::size_t>(run.begin);
        const auto count = quantise<Count>(run.elevation, labels.row(run.row)[begin], plan);
        const std::size_t row =
            static_cast<std::size_t>(run.row) * static_cast<std::size_t>(levels.shape.cols);
        std::fill_n(levels.counts.data() + (row + begin), run.end - run.begin, count);
    });
}

template <typename Count>
PointRows<Count> point_rows(const std::shared_ptr<const ElevationBand>& elevations,
                            const BandTracing& tracing) {
    PointRows<Count> rows;
    rows.labels = labels_of(*elevations, tracing);
    rows.levels = quantise<Count>(*elevations, rows.labels, tracing.image.plan);
    if (tracing.image.clean != nullptr)
        take_clean_levels(*tracing.image.clean, rows.labels, tracing.image.plan, rows.levels);
    rows.elevations = elevations;
    return rows;
}

/// Splits bands into runs on all threads. Each band repeats the rows above it that it depends on.
/// @param work processes the lines on the same thread @param use receives its results on the calling thread
template <typename Count, typename Work, typename Use>
void split_bands_as(ElevationReader& reader, const BandTracing& tracing, const Work& work, const Use& use) {
    reader.for_each_with_halo(
        rows_above(tracing.mode),
        [&](ElevationBand above, const ElevationBand& elevations, Tally& tally) {
            PointRows<Count> before;
            PointRows<Count> band;
            {
                const StageClock clock(tally, Stage::levels);
                before = point_rows<Count>(std::make_shared<ElevationBand>(std::move(above)), tracing);
                const std::shared_ptr<const ElevationBand> borrowed(std::shared_ptr<void>(), &elevations);
                band = point_rows<Count>(borrowed, tracing);
            }
            const StageClock clock(tally, Stage::trace);
            return work(split_into_runs(tracing.frame, tracing.mode, before, band, tracing.summed), tally);
        },
        use);
}

template <typename Work, typename Use>
void split_bands_by_count_type(ElevationReader& reader, const BandTracing& tracing, const Work& work,
                               const Use& use) {
    if (tracing.image.plan.level_count() <= std::numeric_limits<std::uint8_t>::max())
        split_bands_as<std::uint8_t>(reader, tracing, work, use);
    else
        split_bands_as<std::uint16_t>(reader, tracing, work, use);
}

/// Traces all bands. The tracer's memory is released at the end.
void trace_into(ContourArchive& store, ElevationReader& reader, const BandTracing& tracing,
                Context& context) {
    const Window& window = tracing.frame.window;
    Tracer tracer(tracing.frame, tracing.mode, store);
    split_bands_by_count_type(
        reader, tracing,
        [&](std::vector<TraceLine>&& lines, Tally& tally) {
            return trace_band(tracing.frame, tracing.mode, std::move(lines), store, tally);
        },
        [&](const ElevationBand& band, TracedBand traced) {
            {
                const StageClock clock(context.report, Stage::trace);
                join_band(std::move(traced), tracer, store);
            }
            context.progress(static_cast<double>(band.shape.first_row + band.shape.rows - window.row) /
                             window.rows);
        });
}

}  // namespace

void split_bands_into_runs(ElevationReader& reader, const BandTracing& tracing, const UseLines& use) {
    split_bands_by_count_type(
        reader, tracing, [](std::vector<TraceLine>&& lines, Tally&) { return std::move(lines); },
        [&](const ElevationBand& band, std::vector<TraceLine> lines) { use(band.shape, std::move(lines)); });
}

ContourArchive contour_store(const TraceFrame& frame, const FoundBuildings* found, const RunPlan& plan,
                             const SquareArea& area, double metres, Context& context) {
    const NoiseRules noise{plan.asked.filter.noise_factor, plan.contour_m2, plan.detects_buildings()};
    // Detected footprints do not stand on other contours.
    HeightRules heights;
    if (found != nullptr)
        heights = {plan.asked.detect.min_building_height, found->ground, metres};
    return {{noise, area, frame.range, frame.fixed, found == nullptr, plan.asked.write.rejected, heights},
            context.make_spool(),
            context};
}

TracedBand trace_band(const TraceFrame& frame, TraceMode mode, std::vector<TraceLine>&& lines,
                      const ContourArchive& store, Tally& tally) {
    TracedBand band;
    ContourWriter batch_writer = store.batch_writer(band.contours, tally);
    band.linked = Tracer::link(frame, mode, std::move(lines), batch_writer);
    return band;
}

void join_band(TracedBand&& band, Tracer& tracer, ContourArchive& store) {
    tracer.join(std::move(band.linked), store.add(std::move(band.contours)));
}

std::unique_ptr<StoredContours> trace_contours(ElevationReader& reader, const TraceFrame& frame,
                                               const LevelImage& image, const RunPlan& plan,
                                               const SquareArea& area, double metres, Context& context) {
    ContourArchive store = contour_store(frame, image.found, plan, area, metres, context);
    trace_into(store, reader, {frame, image, plan.trace}, context);
    const StageClock clock(context.report, Stage::filter);
    return store.finish();
}

}  // namespace d2b
