#pragma once

#include <string>

#include "core/crs.hpp"
#include "core/lattice.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/error.hpp"
#include "options/run_plan.hpp"

namespace d2b {

/// Returns the bounds of the outlines of a window on the lattice.
[[nodiscard]] LatticeBox lattice_frame(const Window& window, TraceMode mode);

/// True if a line is more than 1000 times as long in a projected CRS as on the ground, because its shape is
/// then lost.
/// @param length in units of the CRS @param ground_m metres
[[nodiscard]] bool is_overstretched(double length, const Crs& crs, double ground_m);

/// Checks that the window of a raster can be represented in the output CRS before any work is done.
/// @param target kind none: the CRS of the DEM
/// @return the centre of the window in the output CRS; not finite if it has no image
/// @throws InputError if the frame of the window is torn, turned inside out or overstretched
/// @throws OptionError if there is no operation between the CRSs
Position require_whole_frame(const DemInfo& info, const RunPlan& plan, const Crs& crs, const Crs& target);

/// Returns the name of a CRS for messages. @param given name as written by the user, preferred to "unknown"
[[nodiscard]] std::string spoken_name(const Crs& crs, const std::string& given);

/// @param input name of the raster @param target display name of the output CRS
[[nodiscard]] InputError torn_apart(const std::string& input, const std::string& target);

}  // namespace d2b
