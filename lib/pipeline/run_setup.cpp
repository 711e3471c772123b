#include "pipeline/run_setup.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>
#include <utility>

#include "core/context.hpp"
#include "core/crs.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/report.hpp"
#include "dem2buildings/sinks.hpp"
#include "dem2buildings/version.hpp"
#include "diagnose/warnings.hpp"
#include "features/contour_drawer.hpp"
#include "features/reprojection.hpp"
#include "features/write_surfaces.hpp"
#include "options/option_checks.hpp"
#include "options/option_table.hpp"
#include "options/provenance_text.hpp"
#include "options/run_plan.hpp"
#include "pipeline/find_buildings.hpp"

namespace d2b {

/// Describes the origin of a dataset: source, options that reproduce it, decided values, thresholds, units
/// and version. Contains nothing that changes from run to run.
[[nodiscard]] Provenance make_provenance(const RunPlan& plan, const DemInfo& info, const Crs& crs,
                                         const Crs& target, const RunReport& report);

namespace {

std::string thresholds_of(const RunReport& report) {
    std::string text;
    for (const LevelReport& level : report.levels)
        if (level.level > 0 && std::isfinite(level.threshold))
            text += (text.empty() ? "" : " ") + number_text(level.threshold);
    return text;
}

/// Returns the decided values of the options that shape the result, by the names in their rows.
std::map<std::string, std::string> decisions(const RunPlan& plan) {
    const Request resolved{plan.resolved(), {}};
    std::map<std::string, std::string> items;
    for (const OptionRow& row : option_table())
        if (!row.item.empty() && has_effect(row, resolved))
            items.emplace("D2B_" + row.item, row.show(resolved));
    return items;
}

}  // namespace

Provenance make_provenance(const RunPlan& plan, const DemInfo& info, const Crs& crs, const Crs& target,
                           const RunReport& report) {
    Provenance provenance;
    provenance.crs_wkt = target.kind() == Crs::Kind::none ? crs.wkt() : target.wkt();
    // A layer must not mix vertical units, or stacked with disjoint contours, because its fields would lose
    // their meaning.
    provenance.binding = {"D2B_VERTICAL_UNIT", "D2B_CONTOURS"};
    provenance.metadata = {
        {"D2B_VERSION", std::string(version)},
        {"D2B_SOURCE", info.name},
        {"D2B_OPTIONS", reproducing_arguments(plan.asked)},
        {"D2B_CONTOURS", plan.asked.outline.disjoint ? "disjoint" : "stacked"},
        {"D2B_THRESHOLDS", thresholds_of(report)},
        {"D2B_MINIMUM", number_text(report.minimum)},
        {"D2B_MAXIMUM", number_text(report.maximum)},
        {"D2B_VERTICAL_UNIT", report.units.vertical},
        {"D2B_VERTICAL_UNIT_FROM", report.units.vertical_decided_by},
        {"D2B_HORIZONTAL_UNIT", report.units.horizontal},
        {"D2B_HORIZONTAL_UNIT_FROM", report.units.horizontal_decided_by},
        {"D2B_AREAS", report.units.areas},
    };
    provenance.metadata.merge(decisions(plan));
    std::erase_if(provenance.metadata, [](const auto& item) { return item.second.empty(); });
    for (auto& [name, value] : provenance.metadata)
        value = utf8_text(value);
    return provenance;
}

namespace {

void start_threads(const RunOptions& options, Context& context) {
    const int wanted = options.threads > 0
                           ? options.threads
                           : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    context.threads = std::make_unique<Executor>(wanted, context.stop, context.on_work);
    const int started = context.threads->threads();
    context.report.threads = started;
    if (started < wanted)
        context.warn("Only " + std::to_string(started) + " of " + std::to_string(wanted) +
                     " threads are at work, since the system allows no more; the result is the same, but "
                     "takes longer.");
}

Crs dem_crs(const Options& options, const DemInfo& dem) {
    const bool given = !options.read.crs.empty();
    Crs crs(given ? options.read.crs : dem.crs_wkt);
    require_plane(crs, given ? "-a_srs " + options.read.crs : "", dem.name);
    return crs;
}

Crs target_crs(const Options& options, const Crs& crs) {
    if (options.outline.target_crs.empty())
        return {};
    if (crs.kind() == Crs::Kind::none)
        throw OptionError("-t_srs needs to know the CRS of the DEM, which has none; give it with -a_srs.");
    return Crs(options.outline.target_crs);
}

/// Asks the destination before the run whether it can store the CRS. @param place a position in that CRS
void require_crs(const Options& options, const Crs& crs, const Crs& target, const Position& place,
                 FeatureSink& sink) {
    const bool moved = target.kind() != Crs::Kind::none;
    const Crs& written = moved ? target : crs;
    const std::string& given = moved ? options.outline.target_crs : options.read.crs;
    sink.require_crs(written.wkt(), display_name(written, given), place);
}

void describe(const DemInfo& dem, const RunPlan& plan, const Crs& crs, const Crs& target, RunReport& report) {
    report.input = dem.name;
    report.driver = dem.driver;
    report.output = redacted_destination(plan.asked.write.destination);
    report.layers = plan.layers;
    report.crs = crs.name();
    report.output_crs = target.kind() == Crs::Kind::none ? crs.name() : target.name();
    report.units = resolve_units(dem, crs, plan.asked.read.vertical_unit);
    report.rows = dem.window.rows;
    report.cols = dem.window.cols;
    report.points = report.rows * report.cols;
}

/// Checks that one unit of the window fits in memory. Windows of a single unit are exempt.
void require_memory(const RunPlan& plan, const Window& window, const CellSize& cell, Context& context) {
    const UnitGrid units = unit_grid(plan, window, cell);
    if (units.count() == 1)
        return;
    const double width = plan.asked.ground.max_building_width;
    SeenPoints seen{units.most_seen(), halo_widths * width, {}};
    if (plan.ground == GroundMode::automatic)
        seen.max_building_width = width;
    if (const std::string text = unit_memory_refusal(seen); !text.empty())
        throw OptionError(text);
    warn_unless_empty(unit_memory_notice(seen), context);
}

void warn_of_scale(const RunSetup& setup, Context& context) {
    const bool on_ground = setup.crs.horizontal_unit() || setup.crs.on_ellipsoid();
    if (on_ground)
        warn_unless_empty(coarse_cells_warning(cell_size_m(setup.dem.window, setup.area)), context);
    warn_unless_empty(
        tolerance_warning(setup.plan.asked.outline.simplify, std::sqrt(setup.georeference.cell_area())),
        context);
}

}  // namespace

RunSetup set_up_run(const Options& asked, const DemInfo& dem, FeatureSink& sink, Context& context) {
    check_options({asked, {}});
    const RunPlan plan = make_run_plan(asked, sink.layers(asked.write.layers));
    const Options& options = plan.asked;
    start_threads(options.run, context);
    const Crs crs = dem_crs(options, dem);
    const Crs target = target_crs(options, crs);
    RunReport& report = context.report;
    describe(dem, plan, crs, target, report);
    const Georeference georeference(dem.transform, plan.trace);
    const Position middle = require_projectable(dem, plan, crs, target);
    const LayerSpecs layers = layer_specs(plan, report.input, report.units.vertical, sink);
    require_crs(options, crs, target, middle, sink);
    sink.preflight(layers.layers, make_provenance(plan, dem, crs, target, report), middle);
    const SquareArea area =
        make_square_area(georeference, crs, lattice_frame({0, 0, dem.rows, dem.cols}, plan.trace));
    const CellSize cell = plan.detects_buildings() ? cell_steps(dem.window, georeference, crs) : CellSize{};
    if (plan.detects_buildings())
        require_memory(plan, dem.window, cell, context);
    RunSetup setup{plan, dem, crs, target, georeference, area, cell, layers};
    warn_of_scale(setup, context);
    return setup;
}

FeatureInput feature_input(const RunSetup& setup, const DrawingInput& drawing, const RunReport& report,
                           std::function<StackError(const DrawnStack&)> stack_error,
                           BuildingRecords* building_records) {
    return {setup.plan,
            setup.georeference,
            setup.crs,
            setup.target,
            drawing.contours,
            drawing.outliner,
            setup.layers,
            make_provenance(setup.plan, setup.dem, setup.crs, setup.target, report),
            setup.dem.window,
            drawing.buildings,
            setup.cell_m(),
            drawing.fixed,
            std::move(stack_error),
            drawing.parcels,
            building_records};
}

OutlineDependencies outline_dependencies_of(const ContourList& contours, const RunSetup& setup,
                                            Context& context) {
    const StageClock clock(context.report, Stage::outline);
    return outline_dependencies_of(contours, setup.plan, setup.georeference, setup.crs, setup.target,
                                   setup.dem.window, setup.cell_m(), context.threads->stop());
}

Outliner draw_outlines(const ContourList& contours, const RunSetup& setup, Context& context) {
    return draw_outlines(contours, setup.plan, setup.georeference, setup.crs, setup.target, setup.dem.window,
                         setup.cell_m(), context);
}

namespace {

/// True if a sink writes meshes, whose readers use single precision.
bool has_shells(const Sinks& sinks) {
    return std::ranges::any_of(sinks.surfaces,
                               [](const SurfaceSink* sink) { return sink->form() == SurfaceForm::shell; });
}

/// True if all surface sinks take tiers.
bool is_page(const Sinks& sinks) {
    return std::ranges::all_of(sinks.surfaces,
                               [](const SurfaceSink* sink) { return sink->form() == SurfaceForm::tiers; });
}

}  // namespace

bool has_tiers(const Sinks& sinks) {
    return std::ranges::any_of(sinks.surfaces,
                               [](const SurfaceSink* sink) { return sink->form() == SurfaceForm::tiers; });
}

std::optional<SurfaceLattice> set_up_surfaces(const RunSetup& setup, const Sinks& sinks,
                                              const UnitReport& units) {
    if (sinks.surfaces.empty())
        return std::nullopt;
    SurfaceLattice lattice({setup.georeference, setup.crs, setup.target, setup.dem.window,
                            lattice_frame(setup.dem.window, setup.plan.trace),
                            cell_size_m(setup.dem.window, setup.area), units.vertical_metres,
                            setup.plan.asked.write.surface_origin, is_page(sinks) ? "-page" : "-surface"});
    if (has_shells(sinks))
        lattice.require_single_precision();
    for (SurfaceSink* sink : sinks.surfaces)
        sink->preflight(surface_meta(setup.plan, lattice, setup.written(), units));
    return lattice;
}

void set_heights(SurfaceLattice& lattice, const ElevationRange& range, const Sinks& sinks) {
    lattice.set_lowest(range.minimum);
    if (has_shells(sinks))
        lattice.require_single_precision(range.minimum, range.maximum);
}

}  // namespace d2b
