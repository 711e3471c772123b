#include <pybind11/pybind11.h>

#include "dem2buildings/help.hpp"
#include "dem2buildings/version.hpp"
#include "python/errors.hpp"
#include "python/extract.hpp"
#include "python/layer.hpp"
#include "python/score.hpp"

/// The module that the package dem2buildings is made on; users import that package.
PYBIND11_MODULE(_core, module) {
    d2b::translate_errors();
    module.attr("version") = d2b::version;
    module.def("options_json", &d2b::options_json);
    d2b::define_layer(module);
    d2b::define_extract(module);
    d2b::define_score(module);
}
