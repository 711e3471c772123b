#include "write/field_json.hpp"

#include <cstddef>
#include <type_traits>
#include <variant>

#include <nlohmann/json.hpp>

namespace d2b {

nlohmann::ordered_json field_json(std::span<const FieldSpec> fields, std::span<const FieldValue> values) {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < fields.size() && i < values.size(); ++i)
        std::visit(
            [&](const auto& value) {
                if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>)
                    object[fields[i].name] = nullptr;
                else
                    object[fields[i].name] = value;
            },
            values[i]);
    return object;
}

std::string json_text(const nlohmann::ordered_json& json) {
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace d2b
