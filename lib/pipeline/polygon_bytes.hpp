#pragma once

#include <vector>

#include "core/byte_stream.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b::pipeline {

/// Serialises polygons for a spool or for another step.
void save(const std::vector<WorldPolygon>& polygons, ByteWriter& writer);
/// Deserialises polygons. @throws CorruptRecord
[[nodiscard]] std::vector<WorldPolygon> load_polygons(ByteReader& reader);

}  // namespace d2b::pipeline
