#pragma once

#include "core/byte_stream.hpp"
#include "core/lattice.hpp"
#include "outline/outline.hpp"

namespace d2b::outline {

/// Serializes a drawn polygon with delta encoding, about four bytes per vertex.
void save(const FinePolygon& polygon, ByteWriter& writer);
[[nodiscard]] FinePolygon load_outline(const Spool& spool, SpoolEntry entry);

/// Drawn outline in a spool.
struct SpooledOutline {
    SpoolEntry place;  ///< empty if there is none
    OutlineQuality quality;
};
[[nodiscard]] SpooledOutline spool_outline(const FinePolygon& outline, const OutlineQuality& quality,
                                           Spool& spool);

}  // namespace d2b::outline
