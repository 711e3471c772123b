#pragma once

#include <memory>
#include <pybind11/pybind11.h>
#include <string>

#include "python/collecting_sink.hpp"

namespace d2b {

/// The class Layer of the module: features as WKB, as columns and as GeoJSON-like dictionaries.
void define_layer(pybind11::module_& module);

/// Values as a NumPy array: int64 (masked where some are NULL), float64 (NaN) or str (None). Numbers are not
/// copied and cannot be changed. @param owner of the column
[[nodiscard]] pybind11::object array_of(const FieldColumn& column, const pybind11::handle& owner);

}  // namespace d2b
