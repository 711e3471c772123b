#pragma once

#include "core/byte_stream.hpp"
#include "core/lattice.hpp"

namespace d2b::outline {

/// Serializes a drawn polygon with delta encoding, about four bytes per vertex.
void save(const FinePolygon& polygon, ByteWriter& bytes);
[[nodiscard]] FinePolygon load_outline(const Spool& spool, SpoolEntry entry);

}  // namespace d2b::outline
