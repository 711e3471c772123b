#pragma once

#include <memory>
#include <string>

#include "core/context.hpp"
#include "core/feature_sink.hpp"
#include "core/options.hpp"

namespace d2b {

/// A vector dataset of any OGR driver that can create one. A new local file is written beside the
/// destination, reopened, counted, synced, then renamed; an existing one is changed in one transaction or
/// replaced whole. The checks that need no result are made here, so that a long run does not fail at its end.
/// @throws OptionError: unknown format or extension, an existing destination without -overwrite or -append, a
///         folder with foreign files. @throws OutputError: not writable
[[nodiscard]] std::unique_ptr<FeatureSink> open_sink(const WriteOptions& options, Context& context);

/// The layers that a destination gets: `automatic` is both, or the buildings alone where the format holds one
/// layer a file. @throws OptionError as open_sink
[[nodiscard]] Layers layers_for(const WriteOptions& options);

/// The name of a layer: -nln, with "_contours" after it for the contours where both layers are written;
/// without -nln "buildings" or "contours", or the stem of the file where a file is a layer.
/// @param layers what layers_for() gave @throws OptionError as open_sink
[[nodiscard]] std::string layer_name_for(const WriteOptions& options, bool buildings, Layers layers);

}  // namespace d2b
