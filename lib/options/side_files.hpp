#pragma once

#include <string>
#include <vector>

#include "dem2buildings/options.hpp"

namespace d2b {

/// Returns the names of rasters, surfaces and the page written besides the layers; "" for those not
/// requested.
[[nodiscard]] inline std::vector<std::string> side_files_of(const WriteOptions& write) {
    std::vector<std::string> names{write.ground, write.height, write.canopy};
    names.push_back(write.page);
    names.insert(names.end(), write.surfaces.begin(), write.surfaces.end());
    return names;
}

}  // namespace d2b
