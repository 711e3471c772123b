#pragma once

#include <span>
#include <string>

#include "dem2buildings/feature_sink.hpp"
#include "write/destination.hpp"

namespace d2b {

/// Makes a new dataset of these layers, without features, and removes it: what the driver refuses (fields,
/// geometries, names, options) is known before the work. In memory; where that fails, beside the destination,
/// since some drivers write to the disk alone.
/// @throws OptionError: names that the format keeps for itself, names of fields that other programs look for
/// and would not find. @throws OutputError with the driver's reason
void rehearse(const Destination& destination, const VectorFormat& format, const WriteOptions& options,
              std::span<const LayerSpec> layers, const std::string& crs_wkt);

}  // namespace d2b
