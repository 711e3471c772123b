#pragma once

#include <string>
#include <vector>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Layer created by this run.
struct NewLayer {
    const LayerSpec& spec;
    std::string table;                 ///< name given by the driver
    std::string geometry;              ///< geometry column
    std::vector<std::string> columns;  ///< column name per field of the spec
};

}  // namespace d2b
