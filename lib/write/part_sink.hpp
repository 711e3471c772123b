#pragma once

#include <cstdint>
#include <memory>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Writes one part of layers that several processes write into one folder: <destination>/<layer>/<part>.fgb,
/// a FlatGeobuf with its own index. Each file replaces an existing one atomically. A layer without features
/// in a part gets no file, except in part 0, which has all layers. @param options of the whole run
/// @pre writes_parts(options)
[[nodiscard]] std::unique_ptr<FeatureSink> open_part_sink(const WriteOptions& options, std::int64_t part,
                                                          const Callbacks& callbacks);

/// True if the destination is a local folder of FlatGeobuf files, whose layers may have parts.
[[nodiscard]] bool writes_parts(const WriteOptions& options);

}  // namespace d2b
