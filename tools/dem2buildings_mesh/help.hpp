// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/tool_texts.hpp"

namespace d2b::mesh {

[[nodiscard]] const ToolTexts& mesh_texts();
/// Completes command lines in Bash.
[[nodiscard]] std::string mesh_bash_completion();

}  // namespace d2b::mesh
