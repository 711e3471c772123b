#include "pipeline/run_setup.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>

#include "core/crs.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/sinks.hpp"
#include "diagnose/warnings.hpp"
#include "features/reprojection.hpp"
#include "features/write_surfaces.hpp"
#include "options/option_checks.hpp"
#include "options/provenance_text.hpp"
#include "options/run_plan.hpp"
#include "pipeline/find_buildings.hpp"

namespace d2b::pipeline {

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
                     " threads are running, because the system allows no more; the result is the same, but "
                     "takes longer.");
}

Crs dem_crs(const Options& options, const DemInfo& dem) {
    const bool given = !options.read.crs.empty();
    Crs crs(given ? options.read.crs : dem.crs_wkt);
    require_plane(crs, given ? "-a_srs " + options.read.crs : "", dem.name);
    return crs;
}

/// Given footprints keep their CRS unless another one is asked for.
Crs target_crs(const Options& options, const Crs& crs, const FootprintSource* footprints) {
    if (options.outline.target_crs.empty())
        return footprints == nullptr ? Crs() : Crs(footprints->crs_wkt());
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
    sink.require_crs(written.wkt(), features::display_name(written, given), place);
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
    const detect::UnitGrid units = unit_grid(plan, window, cell);
    if (units.count() == 1)
        return;
    const double width = plan.asked.ground.max_building_width;
    diagnose::SeenPoints seen{units.most_seen(), halo_widths * width, {}};
    if (plan.ground == GroundMode::automatic)
        seen.max_building_width = width;
    if (const std::string text = diagnose::unit_memory_refusal(seen); !text.empty())
        throw OptionError(text);
    diagnose::warn_unless_empty(diagnose::unit_memory_notice(seen), context);
}

/// Names the fields that given footprints have already.
void warn_of_renamed_fields(const features::LayerSpecs& layers, Context& context) {
    if (!layers.indices.given)
        return;
    std::string names;
    for (const FieldSpec& field : layers.layers[*layers.indices.given].fields)
        if (field.name.starts_with("d2b_"))
            names += (names.empty() ? "" : ", ") + field.name;
    if (!names.empty())
        context.warn("The footprints have fields with names of new ones, so the new ones are called " +
                     names + ".");
}

void warn_of_scale(const features::RunSetup& setup, Context& context) {
    const bool on_ground = setup.crs.horizontal_unit() || setup.crs.on_ellipsoid();
    if (on_ground)
        diagnose::warn_unless_empty(diagnose::coarse_cells_warning(cell_size_m(setup.dem.window, setup.area)),
                                    context);
    diagnose::warn_unless_empty(diagnose::tolerance_warning(setup.plan.asked.outline.simplify,
                                                            std::sqrt(setup.georeference.cell_area())),
                                context);
}

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

features::RunSetup set_up_run(const Options& asked, const DemInfo& dem, FeatureSink& sink, Context& context,
                              const FootprintSource* footprints) {
    check_options({asked, {}});
    const RunPlan plan = make_run_plan(asked, sink.layers(asked.write.layers));
    const Options& options = plan.asked;
    start_threads(options.run, context);
    const Crs crs = dem_crs(options, dem);
    const Crs target = target_crs(options, crs, footprints);
    RunReport& report = context.report;
    describe(dem, plan, crs, target, report);
    features::RunSetup setup{plan, dem, crs, target, Georeference(dem.transform, plan.trace), {}, {}, {}};
    const Position middle = features::require_projectable(dem, plan, crs, target);
    setup.layers = features::layer_specs(plan, report.input, report.units.vertical, sink,
                                         footprints == nullptr ? nullptr : footprints->layer());
    warn_of_renamed_fields(setup.layers, context);
    require_crs(options, crs, target, middle, sink);
    sink.preflight(setup.layers.layers, features::make_provenance(setup, report), middle);
    setup.area = make_square_area(setup.georeference, crs,
                                  features::lattice_frame({0, 0, dem.rows, dem.cols}, plan.trace));
    if (plan.detects_buildings()) {
        setup.cell = cell_steps(dem.window, setup.georeference, crs);
        require_memory(plan, dem.window, setup.cell, context);
    }
    warn_of_scale(setup, context);
    return setup;
}

bool has_tiers(const Sinks& sinks) {
    return std::ranges::any_of(sinks.surfaces,
                               [](const SurfaceSink* sink) { return sink->form() == SurfaceForm::tiers; });
}

std::optional<features::SurfaceLattice> set_up_surfaces(const features::RunSetup& setup, const Sinks& sinks,
                                                        Context& context) {
    const UnitReport& units = context.report.units;
    if (sinks.surfaces.empty())
        return std::nullopt;
    features::SurfaceLattice lattice(
        {setup.georeference, setup.crs, setup.target, setup.dem.window,
         features::lattice_frame(setup.dem.window, setup.plan.trace),
         cell_size_m(setup.dem.window, setup.area), units.vertical_metres,
         setup.plan.asked.write.surface_origin, is_page(sinks) ? "-page" : "-surface",
         setup.plan.surface_of == SurfaceOf::roofs || (has_tiers(sinks) && setup.plan.needs_roofs())});
    if (has_shells(sinks))
        lattice.require_single_precision();
    if (!is_page(sinks))
        diagnose::warn_unless_empty(
            diagnose::surface_scale_warning(setup.written().name(), lattice.area_scale()), context);
    for (SurfaceSink* sink : sinks.surfaces)
        sink->preflight(features::surface_meta(setup.plan, lattice, setup.written(), units));
    return lattice;
}

void set_heights(features::SurfaceLattice& lattice, const ElevationRange& range, const Sinks& sinks) {
    lattice.set_lowest(range.minimum);
    if (has_shells(sinks))
        lattice.require_single_precision(range.minimum, range.maximum);
}

}  // namespace d2b::pipeline
