#include "python/extract.hpp"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include "dem2buildings/command_line.hpp"
#include "dem2buildings/extract_file.hpp"
#include "dem2buildings/json_report.hpp"
#include "dem2buildings/open_sources.hpp"
#include "dem2buildings/run.hpp"
#include "dem2buildings/spool.hpp"
#include "python/array_argument.hpp"
#include "python/collecting_sink.hpp"
#include "python/given_options.hpp"
#include "python/listening_run.hpp"

namespace d2b {
namespace {

namespace py = pybind11;
using PyArray = std::pair<py::array, std::optional<py::array>>;  ///< values, and the masked cells
/// Arrays by their options.
using PyArrays = std::map<std::string, PyArray>;
using Opener = std::function<std::unique_ptr<DemSource>(const ReadOptions&, const Callbacks&)>;

/// Result of extract(), before it has the names that Python users see.
struct Extraction {
    std::vector<std::shared_ptr<CollectedLayer>> layers;
    Provenance provenance;
    std::string report;  ///< as JSON
};

Callbacks callbacks_of(const PythonEars& ears) {
    return {ears.warn, ears.progress, ears.stop, [] { return std::make_unique<FileSpool>(); }, {}};
}

/// @param beside must outlive the result
AuxiliaryArrays side_arrays(const PyArrays& beside) {
    AuxiliaryArrays arrays;
    for (const auto& [option, array] : beside) {
        std::optional<ElevationArray>& place = option == "ground" ? arrays.terrain
                                               : option == "mask" ? arrays.mask
                                                                  : arrays.ndvi;
        place = elevation_array("array", array.first, array.second, std::nullopt);
    }
    return arrays;
}

Extraction extract(const Options& options, const Opener& open, const AuxiliaryArrays& beside,
                   const PythonEars& ears) {
    std::vector<std::string> warnings;
    const Callbacks callbacks = recording_warnings(callbacks_of(ears), warnings);
    const auto source = open(options.read, callbacks);
    const AuxiliarySources side = open_auxiliary_sources(options, source->info(), callbacks, beside);
    CollectingSink sink;
    RunReport report = run(options,
                           {*source, side.terrain.get(), side.mask.get(), side.ndvi.get(), side.parcels.get(),
                            side.footprints.get(), side.exclusion.get(), side.corrections.get()},
                           {sink}, callbacks);
    report.warnings = std::move(warnings);
    return {sink.collected(), sink.provenance(), json_report(report)};
}

py::tuple extract_listening(const GivenOptions& given, const PyArrays& beside, const py::object& listener,
                            const Opener& open, const std::vector<std::string>& sources) {
    Options options = options_of(given);
    options.read.source = source_of(sources);
    const AuxiliaryArrays arrays = side_arrays(beside);
    Extraction result;
    run_listening(listener, [&](const PythonEars& ears) { result = extract(options, open, arrays, ears); });
    return py::make_tuple(result.layers, result.provenance.crs_wkt, result.provenance.metadata,
                          result.report);
}

py::tuple extract_paths(const std::vector<std::string>& paths, const GivenOptions& given,
                        const PyArrays& beside, const py::object& listener) {
    return extract_listening(
        given, beside, listener,
        [](const ReadOptions& options, const Callbacks& callbacks) { return open_dem(options, callbacks); },
        paths);
}

py::tuple extract_array(const py::array& values, const std::optional<py::array>& mask,
                        const std::optional<std::array<double, 6>>& transform, const GivenOptions& given,
                        const PyArrays& beside, const py::object& listener) {
    const ElevationArray array = elevation_array("array", values, mask, transform);
    return extract_listening(given, beside, listener,
                             [&](const ReadOptions& options, const Callbacks& callbacks) {
                                 return open_dem(array, options, callbacks);
                             },
                             {array.name});
}

/// @return the report as JSON
std::string extract_to_file(const std::vector<std::string>& sources, const std::string& destination,
                            const GivenOptions& given, const PyArrays& beside, const py::object& listener) {
    for (const std::string& source : sources)
        require_other_file(source, destination);
    Options options = options_of(given);
    options.read.source = source_of(sources);
    options.write.destination = destination;
    const AuxiliaryArrays arrays = side_arrays(beside);
    std::string report;
    run_listening(listener, [&](const PythonEars& ears) {
        report = json_report(extract_file(options, callbacks_of(ears), {}, arrays));
    });
    return report;
}

}  // namespace

void define_extract(py::module_& module) {
    module.def("extract_paths", &extract_paths);
    module.def("extract_array", &extract_array);
    module.def("extract_file", &extract_to_file);
}

}  // namespace d2b
