#pragma once

#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// An object of the values of a feature under the names of their fields, in their order.
[[nodiscard]] nlohmann::ordered_json field_json(std::span<const FieldSpec> fields,
                                                std::span<const FieldValue> values);

/// On one line. What is not UTF-8 becomes U+FFFD, since JSON cannot hold it.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json);

}  // namespace d2b
