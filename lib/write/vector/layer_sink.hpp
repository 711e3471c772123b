#pragma once

#include <memory>
#include <string>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b::writing {

/// Opens a dataset for a single layer of a given name, or of the file's name in a format that holds one
/// layer.
/// @throws OptionError, OutputError as open_sink()
[[nodiscard]] std::unique_ptr<FeatureSink> open_layer_sink(WriteOptions options, const std::string& layer,
                                                           const Callbacks& callbacks = {});

}  // namespace d2b::writing
