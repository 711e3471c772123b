#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dem2buildings/options.hpp"
#include "write/vector/vector_format.hpp"

namespace d2b::writing {

/// Returns the layers that are asked for, by default both, or the buildings alone if the format holds one
/// layer per file. @throws OptionError if the format cannot hold all layers of the options
[[nodiscard]] Layers resolve_layers(const WriteOptions& options, std::optional<Layers> asked,
                                    const VectorFormat& format);

/// Returns the name of a layer as the driver will create it: -nln, with "_contours" appended for contours if
/// both layers are written, and "_doubtful", "_rejected" and so on for other roles. Without -nln it is
/// default_layer_name(), or the stem of the file if a file is one layer. @param layers result of
/// resolve_layers()
[[nodiscard]] std::string name_of(const WriteOptions& options, const VectorFormat& format, LayerRole role,
                                  Layers layers);

/// Returns the names of all layers that the run writes.
[[nodiscard]] std::vector<std::string> names_of(const WriteOptions& options, const VectorFormat& format,
                                                Layers layers);

}  // namespace d2b::writing
