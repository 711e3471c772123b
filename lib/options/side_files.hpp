#pragma once

#include <string>
#include <vector>

#include "dem2buildings/options.hpp"

namespace d2b {

/// The names of the rasters, surfaces and the page that are written beside the layers; "" for those that are
/// not.
[[nodiscard]] inline std::vector<std::string> side_files_of(const WriteOptions& write) {
    std::vector<std::string> names{write.ground, write.height, write.canopy};
    names.push_back(write.page);
    names.insert(names.end(), write.surfaces.begin(), write.surfaces.end());
    return names;
}

}  // namespace d2b
