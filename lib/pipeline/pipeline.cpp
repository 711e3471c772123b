#include "pipeline/pipeline.hpp"

#include <charconv>
#include <cmath>

#include "core/number_text.hpp"
#include "core/units.hpp"
#include "detect/one_label.hpp"
#include "pipeline/elevation_reader.hpp"
#include "pipeline/emit.hpp"
#include "pipeline/provenance.hpp"
#include "pipeline/square_area.hpp"
#include "pipeline/stage_clock.hpp"
#include "trace/tracer.hpp"

namespace d2b {
namespace {

constexpr double coarsest_cell_m = 3.0;

Crs dem_crs(const Options& options, const DemInfo& info) {
    return Crs(options.read.crs.empty() ? info.crs_wkt : options.read.crs);
}

Crs target_crs(const Options& options, const Crs& crs) {
    if (options.outline.target_crs.empty())
        return {};
    if (crs.kind() == Crs::Kind::none)
        throw OptionError("-t_srs needs to know the CRS of the DEM, which has none; give it with -a_srs.");
    return Crs(options.outline.target_crs);
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

ElevationStatistics collect_statistics(ElevationReader& reader, const Window& window, Context& context) {
    ElevationStatistics statistics;
    reader.for_each([&](const ElevationBand& band) {
        {
            const StageClock clock(context.report, Stage::levels);
            statistics.add(band);
        }
        context.progress(0.3 * (band.shape.first_row + band.shape.rows - window.row) / window.rows);
    });
    return statistics;
}

template <typename Count>
ContourSet trace_contours(ElevationReader& reader, const TraceFrame& frame, const LevelPlan& plan,
                          const Options& options, const SquareArea& area, Context& context) {
    ContourStore store(options.filter, area, frame.range, context);
    Tracer<Count> tracer(frame, options.trace, store);
    reader.for_each([&](const ElevationBand& band) {
        LevelBand<Count> levels;
        LabelBand labels;
        {
            const StageClock clock(context.report, Stage::detect);
            labels = detect_one_label(band, context);
        }
        {
            const StageClock clock(context.report, Stage::levels);
            levels = quantise<Count>(band, labels, plan);
        }
        const StageClock clock(context.report, Stage::trace);
        tracer.trace(band, labels, levels);
        context.progress(0.3 + 0.3 * (band.shape.first_row + band.shape.rows - frame.window.row) /
                                   frame.window.rows);
    });
    {
        const StageClock clock(context.report, Stage::trace);
        tracer.finish();
    }
    const StageClock clock(context.report, Stage::filter);
    return store.finish();
}

LatticeBox lattice_frame(const Window& window, TraceMode mode) {
    const std::int32_t less = mode == TraceMode::points ? 1 : 0;
    return {{window.row, window.col}, {window.row + window.rows - less, window.col + window.cols - less}};
}

void report_result(const Records& records, const LevelPlan& plan, RunReport& report) {
    for (int level = 0; level < plan.level_count(); ++level)
        report.levels.push_back({level, plan.threshold(1, level), 0, 0});
    for (const ContourRecord& record : records.contours) {
        LevelReport& level = report.levels[static_cast<std::size_t>(record.level)];
        ++level.contours;
        level.points += record.points;
    }
}

void warn_of_large_tolerance(double tolerance, const Georeference& georeference, Context& context) {
    constexpr double most_cells = 100;
    const double cells = tolerance / std::sqrt(georeference.cell_area());
    if (cells > most_cells)
        context.warn("-simplify " + number_text(tolerance) + " is " + number_text(std::round(cells)) +
                     " cells wide, which leaves little of a building; it is in units of the input's CRS.");
}

void warn_of_nothing(const LevelPlan& plan, const Records& records, Context& context) {
    const RunReport& report = context.report;
    if (report.valid_points == 0)
        context.warn("'" + report.input + "' has no valid point; the layers are empty.");
    else if (report.minimum == report.maximum)
        context.warn("All valid points of '" + report.input +
                     "' have the same elevation; no building was found.");
    else if (plan.level_count() == 1)
        context.warn(
            "No threshold lies between the lowest and the highest elevation; no building was found.");
    else if (records.buildings.empty())
        context.warn("No building was found; a smaller -nf or -min_area, or more levels, may show some.");
}

}  // namespace

void run(const Options& options, DemSource& source, FeatureSink& sink, Context& context) {
    const DemInfo& info = source.info();
    const Crs crs = dem_crs(options, info);
    const Crs target = target_crs(options, crs);
    RunReport& report = context.report;
    describe(info, crs, target, report);
    report.output = options.write.destination;
    report.units = resolve_units(info, crs, options.read.vertical_unit);
    const Georeference georeference(info.transform, options.trace.mode);
    const SquareArea area = make_square_area(georeference, crs);
    warn_of_coarse_cells(info.window, area, crs, context);
    warn_of_large_tolerance(options.outline.simplify, georeference, context);

    ElevationReader reader(source, context);
    const ElevationStatistics statistics = collect_statistics(reader, info.window, context);
    const LevelPlan plan = plan_global_levels(statistics, options.levels, context);
    const TraceFrame frame{info.window, plan.level_count(), statistics.fixed_point(), statistics.range()};
    const ContourSet set = plan.level_count() <= 255
                               ? trace_contours<std::uint8_t>(reader, frame, plan, options, area, context)
                               : trace_contours<std::uint16_t>(reader, frame, plan, options, area, context);

    Records records;
    {
        const StageClock clock(report, Stage::attributes);
        const FixedPoint fixed = statistics.fixed_point();
        records = make_records({set.contours, set.building, set.buildings, set.percentiles},
                               {plan, fixed, report.units.vertical_metres,
                                lattice_frame(info.window, options.trace.mode), sink.first_id()});
    }
    report_result(records, plan, report);
    warn_of_nothing(plan, records, context);
    const Emission emission{options,
                            georeference,
                            crs,
                            target,
                            set,
                            make_provenance(options, info, crs, target, report),
                            report.units.vertical,
                            info.window};
    emit(emission, records, sink, context);
    context.progress(1);
}

}  // namespace d2b
