#pragma once

#include <string>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Returns title, abstract and lineage of a layer as QGIS metadata (XML).
[[nodiscard]] std::string qgis_metadata(const LayerSpec& spec, const Provenance& provenance);

}  // namespace d2b
