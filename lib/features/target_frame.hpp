#pragma once

#include <string>

#include "core/crs.hpp"
#include "core/lattice.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/error.hpp"
#include "options/run_plan.hpp"

namespace d2b {

/// The box of the lattice that outlines of a window are drawn in.
[[nodiscard]] LatticeBox lattice_frame(const Window& window, TraceMode mode);

/// Whether a line is more than 1000 times as long in a projected CRS as on the ground, where nothing of its
/// form is left.
/// @param length in units of the CRS @param ground_m metres
[[nodiscard]] bool is_overstretched(double length, const Crs& crs, double ground_m);

/// Looks whether the CRS of the output can hold the window of a raster: what cannot be brought there,
/// whatever its features, need not be worked on. @param target kind none: the DEM's
/// @return the middle of the window in the CRS of the output; not finite where it has no image
/// @throws InputError where the frame of the window is torn apart, turned inside out or stretched beyond use
/// @throws OptionError where there is no operation between the two
Position require_whole_frame(const DemInfo& info, const RunPlan& plan, const Crs& crs, const Crs& target);

/// What messages call a CRS. @param given how the user wrote it, which is better than "unknown"
[[nodiscard]] std::string spoken_name(const Crs& crs, const std::string& given);

/// @param input name of the raster @param target spoken name of the CRS of the output
[[nodiscard]] InputError torn_apart(const std::string& input, const std::string& target);

}  // namespace d2b
