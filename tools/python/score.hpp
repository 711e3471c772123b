#pragma once

#include <pybind11/pybind11.h>

namespace d2b {

/// The functions of the module that compare footprints.
void define_score(pybind11::module_& module);

}  // namespace d2b
