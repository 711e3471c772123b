#pragma once

#include <string>

#include "common/tool_texts.hpp"

namespace d2b {

[[nodiscard]] const ToolTexts& score_texts();
/// The options for measures of footprints, as JSON: name, kind and help of each.
[[nodiscard]] std::string score_options_json();

}  // namespace d2b
