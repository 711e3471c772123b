#pragma once

#include <string>
#include <vector>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// A layer that a run has made.
struct NewLayer {
    const LayerSpec& spec;
    std::string table;                 ///< as the driver calls it
    std::string geometry;              ///< its column
    std::vector<std::string> columns;  ///< of each field of the spec
};

}  // namespace d2b
