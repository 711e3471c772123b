#pragma once

#include <cstdint>
#include <memory>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// A part of layers that several processes write into one folder: <destination>/<layer>/<part>.fgb, a
/// FlatGeobuf with an index of its own. Each file appears whole or not at all, in the place of one that is
/// there. A layer of which a part has no features gets no file, but for part 0, which has all layers.
/// @param options of the whole @pre writes_parts(options)
[[nodiscard]] std::unique_ptr<FeatureSink> open_part_sink(const WriteOptions& options, std::int64_t part,
                                                          const Callbacks& callbacks);

/// Whether the destination is a folder of FlatGeobuf files on this machine, in which layers may have parts.
[[nodiscard]] bool writes_parts(const WriteOptions& options);

}  // namespace d2b
