#pragma once

#include <string>

#include "dem2buildings/options.hpp"
#include "diagnose/ground_fit.hpp"

namespace d2b {

/// Returns the reason why a ground cannot be right, and possible remedies: the surface lies more than 2 m
/// above or below it on bare cells, or fewer than 5 % of the cells are bare. A clause without a full stop; ""
/// if the ground is plausible.
/// @param fit fit of the surface to the given or estimated ground or, for GroundMode::none, to 0
/// @param terrain name of the given terrain
[[nodiscard]] std::string ground_doubt(const GroundFit& fit, GroundMode mode, const std::string& terrain);

/// Returns the reason why a raster may not be a surface model: hardly anything rises above its ground. "" if
/// enough does.
/// @param dem name of the raster
[[nodiscard]] std::string surface_doubt(const GroundFit& fit, const std::string& dem);

}  // namespace d2b
