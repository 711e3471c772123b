#pragma once

#include <string>
#include <vector>

namespace d2b {

/// Names of rasters, a line each, as gdalbuildvrt takes them; empty lines count for nothing.
/// @throws InputError the file cannot be read, or has none
[[nodiscard]] std::vector<std::string> listed_rasters(const std::string& list);

}  // namespace d2b
