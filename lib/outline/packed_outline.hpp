#pragma once

#include "core/byte_record.hpp"
#include "core/lattice.hpp"

namespace d2b {

/// A drawn polygon in some four bytes a vertex: from each vertex the way to the next one.
void save(const FinePolygon& polygon, ByteWriter& bytes);
[[nodiscard]] FinePolygon load_outline(const Spool& spool, SpoolEntry entry);

}  // namespace d2b
