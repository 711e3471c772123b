#include "pipeline/set_up_surfaces.hpp"

#include <algorithm>

#include "features/target_frame.hpp"
#include "features/write_surfaces.hpp"

namespace d2b {
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
        sink->rehearse(surface_meta(setup.plan, lattice, setup.written(), units));
    return lattice;
}

void set_heights(SurfaceLattice& lattice, const ElevationRange& range, const Sinks& sinks) {
    lattice.set_lowest(range.minimum);
    if (has_shells(sinks))
        lattice.require_single_precision(range.minimum, range.maximum);
}

}  // namespace d2b
