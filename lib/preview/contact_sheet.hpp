#pragma once

#include <vector>

#include "preview/canvas.hpp"

namespace d2b {

/// Pictures of one size side by side, with a gap between them. @param columns of them, row by row
[[nodiscard]] Image contact_sheet(const std::vector<Image>& pictures, int columns);

}  // namespace d2b
