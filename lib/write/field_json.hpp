#pragma once

#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Returns an object with the values of a feature by field name, in the order of the fields.
[[nodiscard]] nlohmann::ordered_json field_json(std::span<const FieldSpec> fields,
                                                std::span<const FieldValue> values);

/// Returns one line. Invalid UTF-8 becomes U+FFFD, because JSON cannot hold it.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json);

}  // namespace d2b
