#pragma once

#include <string>

#include "dem2buildings/options.hpp"
#include "diagnose/ground_fit.hpp"

namespace d2b {

/// Why a ground cannot be right, and what may help: the surface lies more than 2 m above or below it over
/// what is bare, or fewer than 5 % of the cells are bare. Without a full stop; "" where it may be right.
/// @param fit of the surface to the ground as it was given, estimated or, for GroundMode::none, to 0
/// @param terrain the name of what was given
[[nodiscard]] std::string ground_doubt(const GroundFit& fit, GroundMode mode, const std::string& terrain);

/// Why a surface may be none: next to nothing rises above its ground. "" where enough does.
/// @param dem its name
[[nodiscard]] std::string surface_doubt(const GroundFit& fit, const std::string& dem);

}  // namespace d2b
