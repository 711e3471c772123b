#include "python/score.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "dem2buildings/error.hpp"
#include "dem2buildings/score.hpp"
#include "dem2buildings_score/command_line.hpp"
#include "dem2buildings_score/help.hpp"
#include "dem2buildings_score/report.hpp"
#include "python/collecting_sink.hpp"
#include "python/given_options.hpp"
#include "python/listening_run.hpp"

namespace d2b {
namespace {

namespace py = pybind11;
using LayerPtr = std::shared_ptr<CollectedLayer>;
/// The name of a dataset, or a layer in memory.
using Footprints = std::variant<std::string, LayerPtr>;

ScoreRequest request_of_score(const GivenOptions& given) {
    ScoreCommand command;
    for (const auto& [name, values] : given) {
        const auto option = std::ranges::find(score_options(), name, &ScoreOption::name);
        if (values.front().empty())
            throw OptionError("-" + name + " needs a value: -" + name + " " + option->value + ".");
        option->apply(command, values.front());
    }
    const ScoreRequest& request = command;
    return request;
}

/// The column of heights of that name; of the usual names where it is "". None where there is none.
std::optional<std::size_t> height_column(const CollectedLayer& layer, const std::string& asked) {
    std::vector<std::string> names{"height", "Height", "roof_h"};
    if (!asked.empty())
        names = {asked};
    for (const std::string& name : names) {
        const auto field = std::ranges::find(layer.spec.fields, name, &FieldSpec::name);
        if (field != layer.spec.fields.end() && field->type != FieldType::text)
            return static_cast<std::size_t>(field - layer.spec.fields.begin());
    }
    if (!asked.empty())
        throw OptionError("The result has no heights in a column '" + asked +
                          "'; its columns of numbers can be given.");
    return std::nullopt;
}

std::optional<double> height_of(const FieldColumn& column, std::size_t i) {
    if (column.null[i] != 0)
        return std::nullopt;
    if (const auto* const whole = std::get_if<std::vector<std::int64_t>>(&column.values))
        return static_cast<double>((*whole)[i]);
    return std::get<std::vector<double>>(column.values)[i];
}

/// @param layer_name, height_field as they were asked for
PolygonLayer polygons_of(const CollectedLayer& layer, const std::string& layer_name,
                         const std::string& height_field) {
    if (!layer_name.empty())
        throw OptionError("'" + layer_name +
                          "' cannot be chosen from a result, whose buildings count; leave it out.");
    const std::optional<std::size_t> height = height_column(layer, height_field);
    PolygonLayer polygons{"result", layer.spec.name, layer.crs_wkt, {}, {}};
    if (height)
        polygons.height_field = layer.spec.fields[*height].name;
    for (std::size_t i = 0; i < layer.features.size(); ++i)
        polygons.features.push_back(
            {layer.features[i].parts, height ? height_of(layer.columns[*height], i) : std::nullopt, false});
    return polygons;
}

/// A side in memory, and its name in the request; nothing of a dataset, which has the name that it has.
std::optional<PolygonLayer> in_memory(const Footprints& footprints, const std::string& layer_name,
                                      const std::string& height_field, std::string& dataset) {
    if (const auto* const path = std::get_if<std::string>(&footprints)) {
        dataset = *path;
        return std::nullopt;
    }
    PolygonLayer layer = polygons_of(*std::get<LayerPtr>(footprints), layer_name, height_field);
    dataset = layer.dataset;
    return layer;
}

std::string measure(ScoreRequest request, const Footprints& found, const Footprints& reference,
                    const PythonEars& ears) {
    std::vector<std::string> heard;
    Callbacks callbacks;
    callbacks.on_warning = [&](const std::string& text) {
        heard.push_back(text);
        ears.warn(text);
    };
    const auto found_layer = in_memory(found, request.layer, "", request.found);
    const auto reference_layer =
        in_memory(reference, request.reference_layer, request.height_field, request.reference);
    const ScoreRun run = compare_layers(request, found_layer ? &*found_layer : nullptr,
                                        reference_layer ? &*reference_layer : nullptr, callbacks);
    return score_json(request, run, heard);
}

std::string score_listening(const Footprints& found, const Footprints& reference, const GivenOptions& given,
                            const py::object& listener) {
    const ScoreRequest request = request_of_score(given);
    std::string result;
    run_listening(listener,
                  [&](const PythonEars& ears) { result = measure(request, found, reference, ears); });
    return result;
}

}  // namespace

void define_score(py::module_& module) {
    module.def("score_options_json", &score_options_json);
    module.def("score", &score_listening);
}

}  // namespace d2b
