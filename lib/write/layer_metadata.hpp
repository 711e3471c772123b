#pragma once

#include <string>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Title, abstract and lineage of a layer as an XML document that QGIS reads.
[[nodiscard]] std::string qgis_metadata(const LayerSpec& spec, const Provenance& provenance);

}  // namespace d2b
