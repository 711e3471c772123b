#include "python/collecting_sink.hpp"

#include <limits>
#include <utility>

namespace d2b {
namespace {

FieldColumn empty_column(FieldType type) {
    FieldColumn column;
    if (type == FieldType::real)
        column.values.emplace<std::vector<double>>();
    else if (type == FieldType::text)
        column.values.emplace<std::vector<std::string>>();
    return column;
}

/// Value that marks a missing one in a column.
template <typename Value>
Value no_value() {
    if constexpr (std::is_same_v<Value, double>)
        return std::numeric_limits<double>::quiet_NaN();
    else
        return {};
}

void add_to(FieldColumn& column, const FieldValue& value) {
    column.null.push_back(std::holds_alternative<std::monostate>(value) ? 1 : 0);
    std::visit(
        [&]<typename Value>(std::vector<Value>& values) {
            const auto* const given = std::get_if<Value>(&value);
            values.push_back(given != nullptr ? *given : no_value<Value>());
        },
        column.values);
}

}  // namespace

void CollectingSink::begin(std::span<const LayerSpec> layers, const Provenance& provenance) {
    provenance_ = provenance;
    for (const LayerSpec& spec : layers) {
        auto layer = std::make_shared<CollectedLayer>(CollectedLayer{spec, provenance.crs_wkt, {}, {}});
        for (const FieldSpec& field : spec.fields)
            layer->columns.push_back(empty_column(field.type));
        layers_.push_back(std::move(layer));
    }
}

void CollectingSink::add(std::size_t layer, const Feature& feature) {
    CollectedLayer& kept = *layers_[layer];
    for (std::size_t i = 0; i < kept.columns.size(); ++i)
        add_to(kept.columns[i], feature.values[i]);
    Feature& copy = kept.features.emplace_back();
    copy.parts = feature.parts;
    copy.z = feature.z;
    copy.place = feature.place;
}

}  // namespace d2b
