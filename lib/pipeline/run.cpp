#include "dem2buildings/run.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

#include "core/number_text.hpp"
#include "core/progress_span.hpp"
#include "core/square_area.hpp"
#include "core/stage_clock.hpp"
#include "core/units.hpp"
#include "diagnose/place_doubt.hpp"
#include "diagnose/search_warnings.hpp"
#include "diagnose/strange_values.hpp"
#include "elevations/elevation_reader.hpp"
#include "elevations/sift_rules.hpp"
#include "features/layer_specs.hpp"
#include "features/target_frame.hpp"
#include "features/write_features.hpp"
#include "levels/building_levels.hpp"
#include "levels/clean_tiers.hpp"
#include "options/option_checks.hpp"
#include "options/run_plan.hpp"
#include "pipeline/find_buildings.hpp"
#include "pipeline/provenance.hpp"
#include "pipeline/trace_contours.hpp"

namespace d2b {
namespace {

constexpr double coarsest_cell_m = 3.0;
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

void start_threads(const RunOptions& options, Context& context) {
    const int wanted = options.threads > 0
                           ? options.threads
                           : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    context.threads = std::make_unique<Executor>(wanted, context.stop);
    const int started = context.threads->threads();
    context.report.threads = started;
    if (started < wanted)
        context.warn("Only " + std::to_string(started) + " of " + std::to_string(wanted) +
                     " threads are at work, as the system allows few more; the result is the same, later.");
}

Crs dem_crs(const Options& options, const DemInfo& info) {
    const bool given = !options.read.crs.empty();
    Crs crs(given ? options.read.crs : info.crs_wkt);
    require_plane(crs, given ? "-a_srs " + options.read.crs : "", info.name);
    return crs;
}

Crs target_crs(const Options& options, const Crs& crs) {
    if (options.outline.target_crs.empty())
        return {};
    if (crs.kind() == Crs::Kind::none)
        throw OptionError("-t_srs needs to know the CRS of the DEM, which has none; give it with -a_srs.");
    return Crs(options.outline.target_crs);
}

/// Asks the destination before the work whether it can hold the CRS. @param place in it
void require_crs(const Options& options, const Crs& crs, const Crs& target, const Position& place,
                 FeatureSink& sink) {
    const bool moved = target.kind() != Crs::Kind::none;
    const Crs& written = moved ? target : crs;
    const std::string& given = moved ? options.outline.target_crs : options.read.crs;
    sink.require_crs(written.wkt(), spoken_name(written, given), place);
}

void describe(const DemInfo& info, const Crs& crs, const Crs& target, RunReport& report) {
    report.input = info.name;
    report.driver = info.driver;
    report.crs = crs.name();
    report.output_crs = target.kind() == Crs::Kind::none ? crs.name() : target.name();
    report.rows = info.window.rows;
    report.cols = info.window.cols;
    report.points = report.rows * report.cols;
}

void warn_of_coarse_cells(const Window& window, const SquareArea& area, const Crs& crs, Context& context) {
    if (!crs.horizontal_unit() && !crs.on_ellipsoid())
        return;
    const double size = cell_size_m(window, area);
    if (!(size > coarsest_cell_m))
        return;
    std::array<char, 32> text{};
    const auto [end, error] =
        std::to_chars(text.data(), text.data() + text.size(), size, std::chars_format::fixed, 1);
    context.warn("The cells are " + std::string(text.data(), end) +
                 " m wide, which is too coarse for single buildings; up to 1 m is best, 2.5 m may do.");
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

/// The levels of each building, from the elevations in it.
/// @param clean may be null
LevelPlan plan_levels(ElevationReader& reader, const FoundBuildings& found, const CleanRows* clean,
                      const ElevationStatistics& statistics, const LevelPlan& global, const RunPlan& decided,
                      const Window& window, Context& context) {
    const double metres = context.report.units.vertical_metres;
    BuildingStatistics buildings(found.count(), statistics.fixed_point(),
                                 decided.levels == LevelSource::natural ? metres : 0);
    reader.for_each(
        [&](const ElevationBand& band, Tally& tally) {
            const StageClock clock(tally, Stage::levels);
            return found.band(band.shape, window.row);
        },
        [&](const ElevationBand& band, const LabelBand& labels) {
            const StageClock clock(context.report, Stage::levels);
            buildings.add(clean != nullptr ? clean->clean(band) : band, labels);
        });
    return plan_building_levels(buildings, found.ground, global, decided.asked.levels, decided.levels,
                                metres);
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

void warn_of_large_tolerance(double tolerance, const Georeference& georeference, Context& context) {
    constexpr double most_cells = 100;
    const double cells = tolerance / std::sqrt(georeference.cell_area());
    if (cells > most_cells)
        context.warn("-simplify " + number_text(tolerance) + " is " + number_text(std::round(cells)) +
                     " cells wide, which leaves little of a building; it is in units of the input's CRS.");
}

void warn_of_nothing(const LevelPlan& plan, std::size_t buildings, const DemInfo& dem, Context& context) {
    const RunReport& report = context.report;
    if (report.valid_points == 0)
        context.warn("'" + report.input + "' has no valid point; the layers are empty.");
    else if (report.minimum == report.maximum && buildings == 0)
        context.warn("All valid points of '" + report.input +
                     "' have the same elevation; no building was found.");
    else if (plan.footprints || buildings > 0)
        return;
    else if (plan.level_count() == 1)
        context.warn(
            "No threshold lies between the lowest and the highest elevation; no building was found.");
    else if (const std::string picture = picture_doubt(dem); !picture.empty())
        context.warn("No building was found: " + picture + ".");
    else
        context.warn("No building was found; a smaller -nf or -min_area, or more levels, may show some.");
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
    for (RasterSink* raster : {sinks.ground, sinks.height, sinks.canopy})
        pass(raster);
}

void run_stages(const Options& asked, const Sources& sources, const Sinks& sinks, const BandSize& size,
                Context& context) {
    check_options({asked, {}});
    const RunPlan decided = make_run_plan(asked, sinks.features.layers(asked.write.layers));
    const Options& options = decided.asked;
    start_threads(options.run, context);
    const DemInfo& info = sources.dem.info();
    const Crs crs = dem_crs(options, info);
    const Crs target = target_crs(options, crs);
    RunReport& report = context.report;
    describe(info, crs, target, report);
    report.output = options.write.destination;
    report.layers = decided.layers;
    report.units = resolve_units(info, crs, options.read.vertical_unit);
    const Georeference georeference(info.transform, decided.trace);
    const Position middle = require_whole_frame(info, decided, crs, target);
    sinks.features.rehearse(
        layer_specs(decided, {report.input, report.units.vertical, target.kind() != Crs::Kind::none},
                    sinks.features)
            .layers,
        make_provenance(decided, info, crs, target, report), middle);
    require_crs(options, crs, target, middle, sinks.features);
    const SquareArea area =
        make_square_area(georeference, crs, lattice_frame({0, 0, info.rows, info.cols}, decided.trace));
    warn_of_coarse_cells(info.window, area, crs, context);
    warn_of_large_tolerance(options.outline.simplify, georeference, context);

    ElevationReader reader(sources.dem, context, size);
    const Milestones at = decided.detects_buildings() ? of_buildings : of_thesis;
    const ElevationStatistics statistics =
        within(context, 0, at.read, [&] { return collect_statistics(reader, options, info, context); });
    pass_warnings(sources, sinks, context);
    LevelPlan plan = plan_global_levels(statistics, options.levels, decided.levels, context);
    std::optional<FoundBuildings> found;
    std::optional<CleanRows> clean;
    if (decided.detects_buildings()) {
        found = within(context, at.read, at.found, [&] {
            return find_buildings(decided, sources, sinks, reader, cell_steps(info.window, georeference, crs),
                                  report.units.vertical_metres, context);
        });
        if (options.levels.detail > 0)
            clean =
                clean_tiers(reader, found->labels, found->count(),
                            region_options(options.levels.detail, cell_steps(info.window, georeference, crs),
                                           report.units.vertical_metres),
                            info.window, context);
        plan = plan_levels(reader, *found, clean ? &*clean : nullptr, statistics, plan, decided, info.window,
                           context);
    }
    const FoundBuildings* buildings = found ? &*found : nullptr;
    const TraceFrame frame{info.window, plan.level_count(), statistics.fixed_point(), statistics.range()};
    const auto contours = within(context, at.found, at.traced, [&] {
        return trace_contours(reader, frame, {plan, buildings, clean ? &*clean : nullptr}, decided, area,
                              context);
    });

    pass_warnings(sources, sinks, context);
    const std::vector<Footprint> footprints = found ? std::move(found->footprints) : std::vector<Footprint>();
    RecordMaker records(*contours, {plan, frame.fixed, footprints, report.units.vertical_metres,
                                    lattice_frame(info.window, decided.trace)});
    report_levels(plan, report);
    warn_of_nothing(plan, found ? found->buildings : records.buildings(), info, context);
    if (found)
        warn_of_search(
            {info, decided, report, found->fit, found->sides, cell_steps(info.window, georeference, crs),
             crs.kind() != Crs::Kind::none, found->slope},
            found->buildings > 0, context);
    const FeatureInput input{decided,
                             georeference,
                             crs,
                             target,
                             *contours,
                             make_provenance(decided, info, crs, target, report),
                             report.units.vertical,
                             info.window,
                             found ? found->buildings : std::numeric_limits<Label>::max(),
                             cell_size_m(info.window, area),
                             frame.fixed,
                             [&](const DrawnStack& stack) { return compare(stack, frame.fixed, reader); }};
    within(context, at.traced, at.drawn, [&] { write_features(input, records, sinks.features, context); });
    context.progress(at.drawn);
    const StageClock clock(report, Stage::write);
    for (RasterSink* raster : {sinks.ground, sinks.height, sinks.canopy})
        if (raster != nullptr)
            raster->finish();
    sinks.features.take_report(report);
    sinks.features.finish();
    if (context.on_progress)
        context.on_progress(1);  // the result is there; nobody can stop it any more
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
