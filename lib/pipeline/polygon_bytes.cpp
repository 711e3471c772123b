#include "pipeline/polygon_bytes.hpp"

#include <cstddef>
#include <cstdint>

namespace d2b::pipeline {

void save(const std::vector<WorldPolygon>& polygons, ByteWriter& writer) {
    writer.put(static_cast<std::uint64_t>(polygons.size()));
    for (const WorldPolygon& polygon : polygons) {
        writer.put_list(polygon.exterior);
        writer.put(static_cast<std::uint64_t>(polygon.interiors.size()));
        for (const WorldRing& ring : polygon.interiors)
            writer.put_list(ring);
        writer.put_list(polygon.arcs);
        writer.put_list(polygon.elevations);
    }
}

std::vector<WorldPolygon> load_polygons(ByteReader& reader) {
    std::vector<WorldPolygon> polygons(reader.take_count(4 * sizeof(std::uint64_t)));
    for (WorldPolygon& polygon : polygons) {
        polygon.exterior = reader.take_list<Position>();
        std::size_t vertices = polygon.exterior.size();
        polygon.interiors.resize(reader.take_count(sizeof(std::uint64_t)));
        for (WorldRing& ring : polygon.interiors) {
            ring = reader.take_list<Position>();
            vertices += ring.size();
        }
        polygon.arcs = reader.take_list<CircularArc>();
        polygon.elevations = reader.take_list<double>();
        if (!polygon.elevations.empty() && polygon.elevations.size() != vertices)
            throw CorruptRecord("there are not as many elevations as vertices");
    }
    return polygons;
}

}  // namespace d2b::pipeline
