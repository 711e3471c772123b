#pragma once

#include <string>
#include <vector>

#include "dem2buildings/options.hpp"

namespace d2b {

/// The names of the rasters that are written beside the layers; "" for those that are not.
[[nodiscard]] inline std::vector<std::string> side_rasters_of(const WriteOptions& write) {
    return {write.ground, write.height, write.canopy};
}

}  // namespace d2b
