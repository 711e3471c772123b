#pragma once

#include <string>
#include <vector>

#include "core/options.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// As layers_for(), of a format that is known. @throws OptionError where both layers are asked for and one
/// fits
[[nodiscard]] Layers resolve_layers(const WriteOptions& options, const VectorFormat& format);

/// As layer_name_for(), of a format that is known.
[[nodiscard]] std::string name_of(const WriteOptions& options, const VectorFormat& format, bool buildings,
                                  Layers layers);

/// The names of all layers that the run writes.
[[nodiscard]] std::vector<std::string> names_of(const WriteOptions& options, const VectorFormat& format,
                                                Layers layers);

}  // namespace d2b
