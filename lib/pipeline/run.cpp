#include "pipeline/run.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/context.hpp"
#include "core/crs.hpp"
#include "dem2buildings/version.hpp"
#include "elevations/elevation_reader.hpp"
#include "elevations/filter_invalid.hpp"
#include "elevations/unblended_source.hpp"
#include "features/contour_drawer.hpp"
#include "features/divided_buildings.hpp"
#include "features/flow_outlines.hpp"
#include "features/problem_layer.hpp"
#include "features/reprojection.hpp"
#include "features/suspicious_values.hpp"
#include "features/write_features.hpp"
#include "features/write_surfaces.hpp"
#include "geometry/geos.hpp"
#include "pipeline/extract_roofs.hpp"
#include "pipeline/find_buildings.hpp"
#include "pipeline/report_run.hpp"
#include "pipeline/run_setup.hpp"
#include "pipeline/trace_contours.hpp"
#include "pipeline/write_footprints.hpp"
#include "read/gdal_setup.hpp"

namespace d2b::pipeline {
namespace {

/// Progress of a run at the end of each of its parts, as a share of 1.
struct Milestones {
    double read;
    double found;
    double traced;
    double drawn;
};
constexpr Milestones building_milestones{0.1, 0.55, 0.7, 0.97};
constexpr double share_of_others = 0.6;  ///< of a run with given footprints
constexpr Milestones thesis_milestones{0.3, 0.3, 0.6, 0.97};
const Milestones& milestones(const RunPlan& plan) {
    return plan.detects_buildings() ? building_milestones : thesis_milestones;
}

/// Runs `work` with its progress mapped to [begin, end] and returns its result.
template <typename Work>
auto with_progress(Context& context, double begin, double end, const Work& work) {
    const ProgressSpan span(context, begin, end);
    return work();
}

/// Decides which values are valid elevations and collects their statistics.
ElevationStatistics collect_statistics(ElevationReader& reader, const features::RunSetup& setup,
                                       UnblendedSource& source, Context& context) {
    const Options& options = setup.plan.asked;
    const DemInfo& info = setup.dem;
    // The thesis preset does not filter elevations.
    ValidityRules rules =
        validity_rules(options.read, detects_buildings(options), info, context.report.units.vertical_metres);
    const auto survey_all = [&] {
        return reader.survey(rules, [&](const ElevationBand& band) {
            context.progress(static_cast<double>(band.shape.first_row + band.shape.rows - info.window.row) /
                             info.window.rows);
        });
    };
    ElevationSurvey survey = survey_all();
    const std::int64_t valid = survey.statistics.moments.n;
    const std::int64_t spikes = survey.suspicious.spikes.cells();
    const std::int64_t outside = survey.suspicious.outside.cells();
    FirstPass known{
        survey.border,
        outside == 0 && valid == info.window.points(),
        [&](const std::vector<double>& values) {
            return UndeclaredNodataRules::named_share * (most_cells_of(values, reader) + spikes) >= valid;
        },
        {}};
    if (outside == 0 && spikes == 0)
        known.read = [&](const Window& part, std::span<double> values) { reader.read_part(part, values); };
    const UndeclaredNodata undeclared =
        undeclared_values(source, options, rules, setup.cell_m(), &known, context);
    if (!undeclared.taken.empty() || undeclared.margin.cells > 0) {
        rules.undeclared = undeclared.values();
        source.set_margin(undeclared.margin);
        survey = survey_all();
    }
    features::report_suspicious_values(survey.suspicious, survey.statistics.moments.n, undeclared, info,
                                       options.read, context);
    return survey.statistics;
}

/// Writes the filtered elevations in metres.
void write_elevations(ElevationReader& reader, std::int32_t first_col, RasterSink& sink, double metres) {
    std::vector<float> values;
    reader.for_each([&](const ElevationBand& band) {
        values.resize(band.elevations.size());
        std::ranges::transform(band.elevations, values.begin(),
                               [metres](double z) { return static_cast<float>(z * metres); });
        sink.write({band.shape.first_row, first_col, band.shape.rows, band.shape.cols}, values);
    });
}

/// Sizes of the pieces into which a run divides its window.
struct PieceSizes {
    const BandSize& bands;
    const detect::UnitSize& units;
};

/// Results of the stages before tracing.
struct SearchResult {
    ElevationStatistics statistics;
    contours::LevelPlan global;  ///< levels of the whole DEM
    Tiers tiers;
    std::optional<FoundBuildings> found;
};

/// Runs all stages from the elevations to the levels of buildings. @param lattice null if no surface is asked
/// for
/// @param given null without given footprints; measured
SearchResult search_levels(ElevationReader& reader, const features::RunSetup& setup, const Sources& sources,
                           const Sinks& sinks, UnblendedSource& dem, const detect::UnitSize& size,
                           features::SurfaceLattice* lattice, GivenFootprints* given, Context& context) {
    const RunPlan& decided = setup.plan;
    const Window& window = setup.dem.window;
    const Milestones& at = milestones(decided);
    const double metres = context.report.units.vertical_metres;
    SearchResult result;
    result.statistics =
        with_progress(context, 0, at.read, [&] { return collect_statistics(reader, setup, dem, context); });
    pass_warnings(sources, sinks, context);
    if (lattice != nullptr)
        set_heights(*lattice, result.statistics.range(), sinks);
    if (sinks.elevations != nullptr)
        write_elevations(reader, window.col, *sinks.elevations, metres);
    result.global =
        contours::plan_global_levels(result.statistics, decided.asked.levels, decided.levels, context);
    if (!decided.detects_buildings()) {
        result.tiers.plan = result.global;
        return result;
    }
    result.found = with_progress(context, at.read, at.found, [&] {
        return find_buildings({decided, sources, sinks, reader, {window, setup.cell, metres}, context, given},
                              size);
    });
    result.tiers = plan_tiers(reader, *result.found, window, setup, result.statistics.fixed_point(),
                              result.global, context);
    return result;
}

/// Adjusts outlines to be flow-ready if asked for. @return the changes and remaining problems
std::vector<surface::FlowProblem> make_flow_ready(const contours::StoredContours& contours,
                                                  outline::Outliner& outliner,
                                                  const features::RunSetup& setup, Context& context) {
    const OutlineOptions& asked = setup.plan.asked.outline;
    if (!asked.is_flow_ready())
        return {};
    return features::make_outlines_flow_ready(
        contours, outliner,
        {asked.narrowest_gap(), asked.shortest_wall(), surface::FlowLimits::least_angle,
         surface::FlowLimits::most_share,
         features::flow_metric(setup.georeference, x_stretch(setup.georeference, setup.crs, setup.dem.window),
                               setup.cell_m())},
        context);
}

/// Inputs of the outputs other than features.
struct FurtherOutputs {
    const std::vector<surface::FlowProblem>& flow;
    const features::SurfaceLattice* lattice;  ///< null if no surface is asked for
};

/// Draws the contours and writes them to the sinks.
void write_result(const features::FeatureInput& input, const features::RecordBuilder& records,
                  ElevationReader& reader, const Sinks& sinks, const FurtherOutputs& further,
                  Context& context) {
    const features::RunSetup& setup = input.setup;
    const Milestones& at = milestones(setup.plan);
    const features::SurfaceLattice* const lattice = further.lattice;
    const double written = lattice != nullptr ? (at.traced + 3 * at.drawn) / 4 : at.drawn;
    const std::optional<features::DrawnStack> stack = with_progress(context, at.traced, written, [&] {
        return features::write_features(input, records, sinks.features, context);
    });
    if (stack)
        report_stack_errors(*stack, input.fixed, reader, context.report);
    features::ProblemLayer problems(setup.layers.indices.problems);
    const WriteOptions& write = setup.plan.asked.write;
    if (write.problems)
        problems.note(features::placed_problems(further.flow, input, sinks.features.first_id()));
    if (lattice != nullptr)
        with_progress(context, written, at.drawn, [&] {
            features::write_surfaces(
                {input, records, *input.building_records, *lattice, setup.plan.surface_of, write.surface_roof,
                 write.problems ? &problems : nullptr},
                features::surface_meta(setup.plan, *lattice, setup.written(), context.report.units),
                sinks.surfaces, context);
        });
    problems.write(sinks.features, context);
    context.progress(at.drawn);
}

/// Runs all stages on the calling thread; each stage uses all threads of the context.
///
///     set_up_run -> survey -> find_buildings -> plan_tiers
///                -> trace_contours -> draw_outlines -> write_result
///
/// Stages between the survey and tracing are skipped if the plan does not detect buildings (-preset thesis).
void run_stages(const Options& asked, const Sources& given_sources, const Sinks& sinks,
                const PieceSizes& size, CommitList& commit, Context& context) {
    UnblendedSource dem(given_sources.dem);
    const Sources sources = with_dem(given_sources, dem);
    const DemInfo& info = dem.info();
    const features::RunSetup setup = set_up_run(asked, info, sinks.features, context, sources.footprints);
    const RunPlan& decided = setup.plan;
    RunReport& report = context.report;
    const double metres = report.units.vertical_metres;

    std::optional<features::SurfaceLattice> lattice = set_up_surfaces(setup, sinks, context);
    std::optional<GivenFootprints> given;
    if (sources.footprints != nullptr)
        label_footprints(given.emplace(place_footprints(*sources.footprints, setup, context)), context);
    // Given footprints are measured and written after the others are found.
    std::optional<ProgressSpan> others;
    if (given)
        others.emplace(context, 0, share_of_others);
    ElevationReader reader(dem, context, size.bands);
    SearchResult search = search_levels(reader, setup, sources, sinks, dem, size.units,
                                        lattice ? &*lattice : nullptr, given ? &*given : nullptr, context);
    const contours::LevelPlan& plan = search.tiers.plan;
    FoundBuildings* const found = search.found ? &*search.found : nullptr;
    const contours::TraceFrame frame{info.window, plan.level_count(), search.statistics.fixed_point(),
                                     search.statistics.range()};
    const auto contours = with_progress(context, milestones(decided).found, milestones(decided).traced, [&] {
        return trace_contours(reader, frame, search.tiers, found, setup, context);
    });

    pass_warnings(sources, sinks, context);
    if (found != nullptr)
        report_corrections(sources.corrections, found->effective, decided.asked.detect.corrections, context);
    const std::vector<features::Footprint> nothing_found;
    const std::vector<features::Footprint>& footprints = found != nullptr ? found->footprints : nothing_found;
    const features::RecordBuilder records(*contours, {plan, frame.fixed, footprints, metres,
                                                      features::lattice_frame(info.window, decided.trace)});
    report_levels(plan, plan.level_count(), report);
    const Label last_building = found != nullptr ? found->buildings : std::numeric_limits<Label>::max();
    const std::size_t measured = given ? given->all.size() : 0;
    warn_of_result(setup, plan, buildings_up_to(last_building, *contours) + measured,
                   found != nullptr ? &found->scene : nullptr, sources.terrain, context);
    outline::Outliner outliner = features::draw_outlines(*contours, setup, context);
    const std::vector<surface::FlowProblem> flow = make_flow_ready(*contours, outliner, setup, context);
    std::optional<features::StoredRoofs> roofs;
    if (setup.plan.needs_roofs())
        roofs.emplace(extract_roofs(reader, *found, *contours, outliner, setup, context));
    std::optional<features::BuildingRecords> building_records;
    if (lattice)
        building_records.emplace(context.make_spool());
    const features::FeatureInput input{
        setup,
        *contours,
        outliner,
        last_building,
        frame.fixed,
        sources.parcels,
        building_records ? &*building_records : nullptr,
        roofs ? &*roofs : nullptr,
        features::divided_wholes(features::parts_of_wholes(*contours, footprints)),
        has_tiers(sinks)};
    write_result(input, records, reader, sinks, {flow, lattice ? &*lattice : nullptr}, context);
    others.reset();
    if (given)
        with_progress(context, share_of_others, building_milestones.drawn, [&] {
            write_footprints(std::move(*given), reader, {frame.fixed, frame.range, search.global}, setup,
                             sinks.features, context);
        });
    prepare_sinks(sinks, commit, context);
}

/// Runs all stages and issues the pending warnings, even if a stage throws.
void run_to_commit(const Options& asked, const Sources& sources, const Sinks& sinks, const PieceSizes& size,
                   CommitList& commit, Context& context) {
    try {
        run_stages(asked, sources, sinks, size, commit, context);
    } catch (...) {
        pass_warnings(sources, sinks, context);  // may explain the error
        throw;
    }
    pass_warnings(sources, sinks, context);
}

}  // namespace

RunReport run_in_units(const Options& options, const Sources& sources, const Sinks& sinks,
                       const Callbacks& callbacks, const detect::UnitSize& units, const BandSize& bands) {
    Context context(callbacks);
    CommitList commit;
    run_to_commit(options, sources, sinks, {bands, units}, commit, context);
    commit.publish([&] { pass_warnings(sources, sinks, context); });
    if (context.on_progress)
        context.on_progress(1);
    return std::move(context.report);
}

}  // namespace d2b::pipeline

namespace d2b {

std::string library_versions() {
    return "GDAL " + reading::gdal_version() + ", GEOS " + geos_version() + ", PROJ " + proj_version() +
           ", GeographicLib " + geographiclib_version();
}

RunReport prepare_run(const Options& options, const Sources& sources, const Sinks& sinks, CommitList& commit,
                      const Callbacks& callbacks, const BandSize& size) {
    Context context(callbacks);
    pipeline::run_to_commit(options, sources, sinks, {size, {}}, commit, context);
    return std::move(context.report);
}

RunReport run(const Options& options, const Sources& sources, const Sinks& sinks, const Callbacks& callbacks,
              const BandSize& size) {
    return pipeline::run_in_units(options, sources, sinks, callbacks, {}, size);
}

}  // namespace d2b
