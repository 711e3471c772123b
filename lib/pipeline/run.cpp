#include "dem2buildings/run.hpp"

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/progress_span.hpp"
#include "core/stage_clock.hpp"
#include "diagnose/empty_result.hpp"
#include "diagnose/search_warnings.hpp"
#include "diagnose/strange_values.hpp"
#include "diagnose/warn_of.hpp"
#include "elevations/elevation_reader.hpp"
#include "elevations/sift_rules.hpp"
#include "features/contour_drawer.hpp"
#include "features/flow_outlines.hpp"
#include "features/problem_layer.hpp"
#include "features/target_frame.hpp"
#include "features/write_features.hpp"
#include "features/write_surfaces.hpp"
#include "levels/building_levels.hpp"
#include "levels/clean_tiers.hpp"
#include "pipeline/find_buildings.hpp"
#include "pipeline/provenance.hpp"
#include "pipeline/run_setup.hpp"
#include "pipeline/set_up_surfaces.hpp"
#include "pipeline/trace_contours.hpp"

namespace d2b {
namespace {

constexpr double no_threshold = std::numeric_limits<double>::quiet_NaN();

/// Shares of a run that are done at the end of its parts.
struct Milestones {
    double read;
    double found;
    double traced;
    double drawn;
};
constexpr Milestones of_buildings{0.1, 0.55, 0.7, 0.97};
constexpr Milestones of_thesis{0.3, 0.3, 0.6, 0.97};

/// What `work` gives, where its progress is a part of the whole.
template <typename Work>
auto within(Context& context, double begin, double end, const Work& work) {
    const ProgressSpan span(context, begin, end);
    return work();
}

/// What is an elevation, and the statistics of what is.
ElevationStatistics collect_statistics(ElevationReader& reader, const Options& options, const DemInfo& info,
                                       Context& context) {
    // The thesis preset takes elevations as they are.
    const SiftRules rules =
        sift_rules(options.read, detects_buildings(options), info, context.report.units.vertical_metres);
    const ElevationSurvey survey = reader.survey(rules, [&](const ElevationBand& band) {
        context.progress(static_cast<double>(band.shape.first_row + band.shape.rows - info.window.row) /
                         info.window.rows);
    });
    report_strange_values(survey.strange, survey.statistics.moments.n, info, options.read, context);
    return survey.statistics;
}

/// The elevations that all else is found in, in metres.
void write_elevations(ElevationReader& reader, std::int32_t first_col, RasterSink& sink, double metres) {
    std::vector<float> values;
    reader.for_each([&](const ElevationBand& band) {
        values.resize(band.elevations.size());
        std::ranges::transform(band.elevations, values.begin(),
                               [metres](double z) { return static_cast<float>(z * metres); });
        sink.write({band.shape.first_row, first_col, band.shape.rows, band.shape.cols}, values);
    });
}

/// The levels of each building, from the elevations in it.
/// @param clean may be null
LevelPlan plan_levels(ElevationReader& reader, const FoundBuildings& found, const CleanRows* clean,
                      const ElevationStatistics& statistics, const LevelPlan& global, const RunPlan& decided,
                      double border_price, Context& context) {
    struct Prepared {
        LabelBand labels;
        std::optional<ElevationBand> clean;
    };
    const double metres = context.report.units.vertical_metres;
    BuildingStatistics buildings(found.count(), statistics.fixed_point(),
                                 decided.levels == LevelSource::natural ? metres : 0);
    reader.for_each(
        [&](const ElevationBand& band, Tally& tally) {
            const StageClock clock(tally, Stage::levels);
            Prepared prepared{found.band(band.shape), {}};
            if (clean != nullptr)
                prepared.clean = clean->clean(band);
            return prepared;
        },
        [&](const ElevationBand& band, const Prepared& prepared) {
            const StageClock clock(context.report, Stage::levels);
            buildings.add(prepared.clean ? *prepared.clean : band, prepared.labels);
        });
    return plan_building_levels(buildings, found.ground, global, decided.asked.levels, decided.levels, metres,
                                border_price);
}

/// @param stack as it is drawn
StackError compare(const DrawnStack& stack, const FixedPoint& fixed, ElevationReader& reader) {
    StackError error;
    reader.for_each(
        [&](const ElevationBand& band, Tally& tally) {
            const StageClock clock(tally, Stage::attributes);
            return stack.error(band, fixed);
        },
        [&](const ElevationBand&, const StackError& of_band) { error.merge(of_band); });
    return error;
}

void report_levels(const LevelPlan& plan, RunReport& report) {
    for (int level = 0; level < plan.level_count(); ++level)
        report.levels.push_back(
            {level, plan.footprints && level > 0 ? no_threshold : plan.threshold(1, level), 0, 0});
}

/// Labels above the last are doubtful.
std::size_t buildings_up_to(Label last, const ContourList& contours) {
    std::size_t buildings = 0;
    for (std::size_t i = 0; i < contours.size(); ++i)
        if (contours.head(i).key.level == 1 && contours.head(i).label <= last)
            ++buildings;
    return buildings;
}

/// Warns of what sources and sinks have noticed, on whichever thread.
void pass_warnings(const Sources& sources, const Sinks& sinks, Context& context) {
    const auto pass = [&](auto* from) {
        if (from != nullptr)
            for (const std::string& text : from->take_warnings())
                context.warn(text);
    };
    for (DemSource* source : {&sources.dem, sources.terrain, sources.mask, sources.ndvi})
        pass(source);
    pass(&sinks.features);
    for (SurfaceSink* surface : sinks.surfaces)
        pass(surface);
    for (RasterSink* raster : {sinks.ground, sinks.height, sinks.canopy, sinks.elevations})
        pass(raster);
}

void finish(const Sinks& sinks, Context& context) {
    const StageClock clock(context.report, Stage::write);
    for (RasterSink* raster : {sinks.ground, sinks.height, sinks.canopy, sinks.elevations})
        if (raster != nullptr)
            raster->finish();
    for (SurfaceSink* surface : sinks.surfaces)
        surface->finish();
    sinks.features.take_report(context.report);
    sinks.features.finish();
    if (context.on_progress)
        context.on_progress(1);  // the result is there; nobody can stop it any more
}

void run_stages(const Options& asked, const Sources& sources, const Sinks& sinks, const BandSize& size,
                Context& context) {
    const DemInfo& info = sources.dem.info();
    const RunSetup setup = set_up_run(asked, info, sinks.features, context);
    const RunPlan& decided = setup.plan;
    const Options& options = decided.asked;
    RunReport& report = context.report;
    const double metres = report.units.vertical_metres;

    std::optional<SurfaceLattice> lattice = set_up_surfaces(setup, sinks, report.units);
    ElevationReader reader(sources.dem, context, size);
    const Milestones at = decided.detects_buildings() ? of_buildings : of_thesis;
    const ElevationStatistics statistics =
        within(context, 0, at.read, [&] { return collect_statistics(reader, options, info, context); });
    pass_warnings(sources, sinks, context);
    if (lattice)
        set_heights(*lattice, statistics.range(), sinks);
    if (sinks.elevations != nullptr)
        write_elevations(reader, info.window.col, *sinks.elevations, metres);
    LevelPlan plan = plan_global_levels(statistics, options.levels, decided.levels, context);
    std::optional<FoundBuildings> found;
    std::optional<CleanRows> clean;
    if (decided.detects_buildings()) {
        found = within(context, at.read, at.found, [&] {
            return find_buildings(
                {decided, sources, sinks, reader, {info.window, setup.cell, metres}, context});
        });
        const RegionOptions regions = region_options(decided.detail, setup.cell, metres);
        if (decided.detail > 0)
            clean = clean_tiers(reader, found->labels, found->count(), regions, info.window, context);
        plan = plan_levels(reader, *found, clean ? &*clean : nullptr, statistics, plan, decided,
                           regions.price, context);
    }
    const TraceFrame frame{info.window, plan.level_count(), statistics.fixed_point(), statistics.range()};
    const auto contours = within(context, at.found, at.traced, [&] {
        return trace_contours(reader, frame, {plan, found ? &*found : nullptr, clean ? &*clean : nullptr},
                              decided, setup.area, metres, context);
    });

    pass_warnings(sources, sinks, context);
    const std::vector<Footprint> footprints = found ? std::move(found->footprints) : std::vector<Footprint>();
    RecordMaker records(*contours,
                        {plan, frame.fixed, footprints, metres, lattice_frame(info.window, decided.trace)});
    report_levels(plan, report);
    const Label last_building = found ? found->buildings : std::numeric_limits<Label>::max();
    const std::size_t buildings_kept = buildings_up_to(last_building, *contours);
    warn_of(empty_result(plan, buildings_kept, info, report), context);
    if (found)
        warn_of_search({info, decided, report, found->fit, found->sides, setup.cell,
                        setup.crs.kind() != Crs::Kind::none, found->slope},
                       buildings_kept > 0, context);
    const double cell_m = cell_size_m(info.window, setup.area);
    Outliner outliner = draw_outlines(*contours, decided, setup.georeference, setup.crs, setup.target,
                                      info.window, cell_m, context);
    std::vector<FlowProblem> flow;
    if (options.outline.is_flow_ready())
        flow = make_outlines_flow_ready(
            *contours, outliner,
            {options.outline.narrowest_gap(), options.outline.shortest_wall(), FlowLimits::least_angle,
             FlowLimits::most_share,
             flow_metric(setup.georeference, x_stretch(setup.georeference, setup.crs, info.window), cell_m)},
            context);
    std::optional<BuildingRecords> kept;
    if (lattice)
        kept.emplace(context.make_spool());
    const FeatureInput input{decided,
                             setup.georeference,
                             setup.crs,
                             setup.target,
                             *contours,
                             outliner,
                             setup.layers,
                             make_provenance(decided, info, setup.crs, setup.target, report),
                             info.window,
                             last_building,
                             cell_m,
                             frame.fixed,
                             [&](const DrawnStack& stack) { return compare(stack, frame.fixed, reader); },
                             kept ? &*kept : nullptr};
    const double written = lattice ? (at.traced + 3 * at.drawn) / 4 : at.drawn;
    within(context, at.traced, written, [&] { write_features(input, records, sinks.features, context); });
    ProblemLayer problems(setup.layers.places.problems);
    if (options.write.problems)
        problems.note(placed_problems(flow, input, sinks.features.first_id()));
    if (lattice)
        within(context, written, at.drawn, [&] {
            write_surfaces({input, records, *kept, *lattice, decided.surface_of, options.write.surface_roof,
                            options.write.problems ? &problems : nullptr},
                           surface_meta(decided, *lattice, setup.written(), report.units), sinks.surfaces,
                           context);
        });
    problems.write(sinks.features, context);
    context.progress(at.drawn);
    finish(sinks, context);
}

}  // namespace

RunReport run(const Options& options, const Sources& sources, const Sinks& sinks, const Callbacks& callbacks,
              const BandSize& size) {
    Context context(callbacks);
    try {
        run_stages(options, sources, sinks, size, context);
    } catch (...) {
        pass_warnings(sources, sinks, context);  // which may say why
        throw;
    }
    pass_warnings(sources, sinks, context);
    return std::move(context.report);
}

}  // namespace d2b
