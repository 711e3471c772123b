#pragma once

#include <cstdint>

namespace d2b {

/// A label that detection gives to the cells of one object; 0 is no object.
using Label = std::uint32_t;

}  // namespace d2b
