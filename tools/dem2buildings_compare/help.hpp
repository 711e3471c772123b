#pragma once

#include "common/tool_texts.hpp"

namespace d2b {

[[nodiscard]] const ToolTexts& compare_texts();

}  // namespace d2b
