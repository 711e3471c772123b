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

#include "core/warnings.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings_score/command_line.hpp"
#include "dem2buildings_score/help.hpp"
#include "dem2buildings_score/report.hpp"
#include "python/collecting_sink.hpp"
#include "python/given_options.hpp"
#include "python/listening_run.hpp"
#include "score/compare.hpp"

namespace d2b {
namespace {

namespace py = pybind11;
using LayerPtr = std::shared_ptr<CollectedLayer>;
/// The name of a dataset, or a layer in memory.
using Footprints = std::variant<std::string, LayerPtr>;

ScoreCommand request_of_score(const GivenOptions& given) {
    ScoreCommand request;
    for (const auto& [name, values] : given) {
        const auto option = std::ranges::find(score_options(), name, &ScoreOption::name);
        if (values.front().empty())
            throw OptionError("-" + name + " needs a value: -" + name + " " + option->value + ".");
        option->apply(request, values.front());
    }
    return request;
}

/// The column of heights that the choice names, the first of its defaults, or none.
std::optional<std::size_t> height_column(const CollectedLayer& layer, const LayerChoice& choice) {
    std::vector<std::string> names = choice.default_heights;
    if (!choice.height_field.empty())
        names = {choice.height_field};
    for (const std::string& name : names) {
        const auto field = std::ranges::find(layer.spec.fields, name, &FieldSpec::name);
        if (field != layer.spec.fields.end() && field->type != FieldType::text)
            return static_cast<std::size_t>(field - layer.spec.fields.begin());
    }
    if (!choice.height_field.empty())
        throw OptionError("The result has no heights in a column '" + choice.height_field +
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

PolygonLayer polygons_of(const CollectedLayer& layer, const LayerChoice& choice) {
    if (!choice.layer.empty())
        throw OptionError("'" + choice.layer + "' cannot be chosen from a result, whose buildings count; " +
                          "leave it out.");
    const std::optional<std::size_t> height = height_column(layer, choice);
    PolygonLayer polygons{choice.dataset, layer.spec.name, layer.crs_wkt, {}, {}};
    if (height)
        polygons.height_field = layer.spec.fields[*height].name;
    for (std::size_t i = 0; i < layer.features.size(); ++i)
        polygons.features.push_back(
            {layer.features[i].parts, height ? height_of(layer.columns[*height], i) : std::nullopt, false});
    return polygons;
}

PolygonLayer footprints_of(const Footprints& footprints, LayerChoice choice, Warnings& warnings) {
    if (const auto* const layer = std::get_if<LayerPtr>(&footprints)) {
        choice.dataset = "result";
        return polygons_of(**layer, choice);
    }
    return read_polygon_layer(choice, warnings);
}

std::string dataset_of(const Footprints& footprints) {
    const auto* const path = std::get_if<std::string>(&footprints);
    return path != nullptr ? *path : "";
}

std::string measure(ScoreRequest request, const Footprints& found, const Footprints& reference,
                    const PythonEars& ears) {
    std::vector<std::string> heard;
    Warnings warnings([&](const std::string& text) {
        heard.push_back(text);
        ears.warn(text);
    });
    const PolygonLayer found_layer = footprints_of(found, found_choice(request), warnings);
    const PolygonLayer reference_layer = footprints_of(reference, reference_choice(request), warnings);
    const ScoreRun run = compare_layers(request, found_layer, reference_layer, warnings);
    request.found = found_layer.dataset;
    request.reference = reference_layer.dataset;
    return score_json(request, run, heard);
}

std::string score_listening(const Footprints& found, const Footprints& reference, const GivenOptions& given,
                            const py::object& listener) {
    ScoreRequest request = request_of_score(given);
    request.found = dataset_of(found);
    request.reference = dataset_of(reference);
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
