#pragma once

#include <cstdint>

namespace d2b {

/// Label of the detected object that a cell belongs to; 0 if it belongs to none.
using Label = std::uint32_t;

}  // namespace d2b
