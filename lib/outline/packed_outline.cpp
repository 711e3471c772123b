#include "outline/packed_outline.hpp"

#include "core/for_rings.hpp"

namespace d2b::outline {

void save(const FinePolygon& polygon, ByteWriter& writer) {
    FinePoint at;
    const auto put = [&](const FineRing& ring) {
        writer.put_zigzag(static_cast<std::int64_t>(ring.size()));
        for (const FinePoint p : ring) {
            writer.put_zigzag(p.row - at.row);
            writer.put_zigzag(p.col - at.col);
            at = p;
        }
    };
    writer.put_zigzag(static_cast<std::int64_t>(polygon.interiors.size()));
    for_rings(polygon, put);
    writer.put_zigzag(static_cast<std::int64_t>(polygon.arcs.size()));
    for (const CircularArc& span : polygon.arcs) {
        writer.put_zigzag(span.ring);
        writer.put_zigzag(span.first);
        writer.put_zigzag(span.edges);
    }
}

FinePolygon load_outline(const Spool& spool, SpoolEntry entry) {
    ByteReader reader(spool, entry);
    const auto take_count = [&] { return static_cast<std::uint32_t>(reader.take_zigzag()); };
    FinePoint at;
    const auto take = [&](FineRing& ring) {
        ring.resize(take_count());
        for (FinePoint& p : ring) {
            at.row += reader.take_zigzag();
            at.col += reader.take_zigzag();
            p = at;
        }
    };
    FinePolygon polygon;
    polygon.interiors.resize(take_count());
    for_rings(polygon, take);
    polygon.arcs.resize(take_count());
    for (CircularArc& span : polygon.arcs)
        span = {take_count(), take_count(), take_count()};
    return polygon;
}

SpooledOutline spool_outline(const FinePolygon& outline, const OutlineQuality& quality, Spool& spool) {
    ByteWriter writer;
    save(outline, writer);
    return {append(spool, writer), quality};
}

}  // namespace d2b::outline
