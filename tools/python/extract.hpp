#pragma once

#include <pybind11/pybind11.h>

namespace d2b {

/// The functions of the module that extract: from an array or a path to layers in memory.
void define_extract(pybind11::module_& module);

}  // namespace d2b
