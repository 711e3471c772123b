#pragma once

#include <array>
#include <optional>
#include <pybind11/numpy.h>
#include <string>

#include "dem2buildings/open_sources.hpp"

namespace d2b {

/// A NumPy array of two dimensions as it lies in memory; it must outlive the result.
/// @param mask a NumPy array of bool of the same shape, true where a point is not valid; or nothing
/// @throws pybind11::type_error where it has no elevations
[[nodiscard]] ElevationArray elevation_array(std::string name, const pybind11::array& values,
                                             const std::optional<pybind11::array>& mask,
                                             const std::optional<std::array<double, 6>>& transform);

}  // namespace d2b
