#pragma once

#include <string>
#include <vector>

#include "dem2buildings/options.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// The layers that a destination gets: those that are asked for, else both, or the buildings alone where the
/// format holds one layer per file. @throws OptionError where both layers are asked for and one fits
[[nodiscard]] Layers resolve_layers(const WriteOptions& options, const VectorFormat& format);

/// The name of a layer: -nln, with "_contours" after it for the contours where both layers are written, and
/// "_doubtful", "_rejected" and "_problems" for what is that; without -nln "buildings", "contours",
/// "doubtful", "rejected" or "problems", or the stem of the file where a file is a layer. As the driver will
/// call it (laundered_name.hpp). @param layers what resolve_layers() gave
[[nodiscard]] std::string name_of(const WriteOptions& options, const VectorFormat& format, LayerRole role,
                                  Layers layers);

/// The names of all layers that the run writes.
[[nodiscard]] std::vector<std::string> names_of(const WriteOptions& options, const VectorFormat& format,
                                                Layers layers);

}  // namespace d2b
