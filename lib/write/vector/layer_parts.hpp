#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b::writing {

/// Writes one part of layers that several processes write into one folder: <destination>/<layer>/<part>.fgb,
/// a FlatGeobuf with its own index. Each file replaces an existing one atomically. A layer without features
/// in a part gets no file, except in part 0, which has all layers. @param options of the whole run
/// @pre writes_parts(options)
[[nodiscard]] std::unique_ptr<FeatureSink> open_part_sink(const WriteOptions& options, std::int64_t part,
                                                          const Callbacks& callbacks);

/// True if the destination is a local folder of FlatGeobuf files, whose layers may have parts.
[[nodiscard]] bool writes_parts(const WriteOptions& options);

/// Layer whose parts were written by PartSink.
struct LayerMosaic {
    LayerSpec spec;
    std::string crs_wkt;  ///< "" for none
    std::int64_t features = 0;
    Position least{};  ///< minimum of all vertices
    Position most{};
    std::vector<std::int64_t> parts;  ///< numbers of the parts that have a file
};

/// Prepares <destination>/<layer>.vrt, which presents all parts as one layer to GDAL and programs based on
/// it, such as QGIS. Replaces an existing one atomically. @throws OutputError
[[nodiscard]] std::unique_ptr<PendingResult> prepare_layer_mosaic(const WriteOptions& options,
                                                                  const LayerMosaic& mosaic);

}  // namespace d2b::writing
