#pragma once

#include <optional>

#include "core/elevation_sample.hpp"
#include "dem2buildings/run.hpp"
#include "features/surface_lattice.hpp"
#include "pipeline/run_setup.hpp"

namespace d2b {

/// Where the surfaces of a run lie; asks the sinks whether they can hold it. @return nothing where there are
/// none @throws OptionError, OutputError
[[nodiscard]] std::optional<SurfaceLattice> set_up_surfaces(const RunSetup& setup, const Sinks& sinks,
                                                            const UnitReport& units);

/// Whether a sink gets the tiers of stacks.
[[nodiscard]] bool has_tiers(const Sinks& sinks);

/// Told as soon as it is known. @param range of the elevations, in the vertical unit @throws OptionError
void set_heights(SurfaceLattice& lattice, const ElevationRange& range, const Sinks& sinks);

}  // namespace d2b
