#pragma once

#include <optional>

#include "core/context.hpp"
#include "core/statistics.hpp"
#include "dem2buildings/report.hpp"
#include "dem2buildings/run.hpp"
#include "features/run_setup.hpp"
#include "features/surface_lattice.hpp"

namespace d2b::pipeline {

/// Validates the options, decides the open ones, starts the threads, and asks the destination whether it can
/// hold the result, because an impossible request should fail before the work, not after it.
/// @param footprints those given; null without
/// @throws OptionError, InputError, OutputError
[[nodiscard]] features::RunSetup set_up_run(const Options& asked, const DemInfo& dem, FeatureSink& sink,
                                            Context& context, const FootprintSource* footprints = nullptr);

/// Creates the lattice of the run's surfaces and asks the sinks whether they can hold it. @return nullopt if
/// there are none
/// @throws OptionError, OutputError
[[nodiscard]] std::optional<features::SurfaceLattice> set_up_surfaces(const features::RunSetup& setup,
                                                                      const Sinks& sinks, Context& context);

/// True if a sink takes the tiers of stacks.
[[nodiscard]] bool has_tiers(const Sinks& sinks);

/// Passes on the elevation range as soon as it is known. @param range in the vertical unit @throws
/// OptionError
void set_heights(features::SurfaceLattice& lattice, const ElevationRange& range, const Sinks& sinks);

}  // namespace d2b::pipeline
