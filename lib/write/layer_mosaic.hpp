#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// A layer whose parts PartSink has written.
struct LayerMosaic {
    LayerSpec spec;
    std::string crs_wkt;  ///< "" for none
    std::int64_t features = 0;
    Position least{};  ///< of all vertices
    Position most{};
    std::vector<std::int64_t> parts;  ///< that have a file
};

/// <destination>/<layer>.vrt, in which GDAL and what builds on it, as QGIS, see all parts as one layer. It
/// appears whole or not at all, in the place of one that is there. @throws OutputError
[[nodiscard]] std::unique_ptr<PendingResult> prepare_layer_mosaic(const WriteOptions& options,
                                                                  const LayerMosaic& mosaic);

}  // namespace d2b
