#include "outline/packed_outline.hpp"

#include "core/for_rings.hpp"

namespace d2b::outline {
namespace {

/// Writes variable-length integers: zigzag encoding in groups of seven bits (as in Protocol Buffers).
class VarintWriter {
  public:
    explicit VarintWriter(ByteWriter& writer) : writer_(writer) {}
    void put(std::int64_t value) {
        auto rest = (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
        for (; rest >= 0x80; rest >>= 7)
            writer_.put(static_cast<std::uint8_t>(rest | 0x80));
        writer_.put(static_cast<std::uint8_t>(rest));
    }

  private:
    ByteWriter& writer_;
};

class VarintReader {
  public:
    explicit VarintReader(ByteReader& reader) : reader_(reader) {}
    std::int64_t take() {
        std::uint64_t value = 0;
        unsigned shift = 0;
        auto byte = reader_.take<std::uint8_t>();
        for (; (byte & 0x80) != 0; byte = reader_.take<std::uint8_t>(), shift += 7)
            value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
        value |= static_cast<std::uint64_t>(byte) << shift;
        return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
    }
    std::uint32_t take_uint32() { return static_cast<std::uint32_t>(take()); }

  private:
    ByteReader& reader_;
};

}  // namespace

void save(const FinePolygon& polygon, ByteWriter& bytes) {
    VarintWriter writer(bytes);
    FinePoint at;
    const auto put = [&](const FineRing& ring) {
        writer.put(static_cast<std::int64_t>(ring.size()));
        for (const FinePoint p : ring) {
            writer.put(p.row - at.row);
            writer.put(p.col - at.col);
            at = p;
        }
    };
    writer.put(static_cast<std::int64_t>(polygon.interiors.size()));
    for_rings(polygon, put);
    writer.put(static_cast<std::int64_t>(polygon.arcs.size()));
    for (const CircularArc& span : polygon.arcs) {
        writer.put(span.ring);
        writer.put(span.first);
        writer.put(span.edges);
    }
}

FinePolygon load_outline(const Spool& spool, SpoolEntry entry) {
    ByteReader bytes(spool, entry);
    VarintReader reader(bytes);
    FinePoint at;
    const auto take = [&](FineRing& ring) {
        ring.resize(reader.take_uint32());
        for (FinePoint& p : ring) {
            at.row += reader.take();
            at.col += reader.take();
            p = at;
        }
    };
    FinePolygon polygon;
    polygon.interiors.resize(reader.take_uint32());
    for_rings(polygon, take);
    polygon.arcs.resize(reader.take_uint32());
    for (CircularArc& span : polygon.arcs)
        span = {reader.take_uint32(), reader.take_uint32(), reader.take_uint32()};
    return polygon;
}

SpooledOutline spool_outline(const FinePolygon& outline, const OutlineQuality& quality, Spool& spool) {
    ByteWriter writer;
    save(outline, writer);
    return {append(spool, writer), quality};
}

}  // namespace d2b::outline
