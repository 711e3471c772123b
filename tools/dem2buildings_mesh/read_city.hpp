// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "dem2buildings_mesh/city_model.hpp"

namespace d2b::mesh {

/// Reads CityJSON 2.0 as `dem2buildings -surface` writes it: buildings, a solid each.
/// @param text the whole file @param name for messages
/// @throws InputError a sentence: no JSON, nested too deep, not CityJSON 2.0, numbers that are none, indices
/// out of range, an object that is not a building, a solid that is open, roofs that are not level, walls that
/// lean
[[nodiscard]] CityModel parse_city(const std::string& text, const std::string& name);

/// The same from a file. @throws InputError also where it cannot be read
[[nodiscard]] CityModel read_city(const std::string& path);

}  // namespace d2b::mesh
