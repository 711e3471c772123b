#include "features/stored_roofs.hpp"

#include <cstdint>

#include "core/byte_stream.hpp"

namespace d2b::features {

void StoredRoofs::put(std::size_t contour, const roofs::Roof& roof, const RoofRecord& record) {
    ByteWriter writer;
    writer.put(static_cast<std::uint64_t>(roof.faces.size()));
    for (const roofs::RoofFace& face : roof.faces) {
        writer.put_list(face.outline.exterior);
        writer.put(static_cast<std::uint64_t>(face.outline.interiors.size()));
        for (const FineRing& ring : face.outline.interiors)
            writer.put_list(ring);
        writer.put_list(face.elevations);
        writer.put(face.measure);
    }
    places_[contour] = append(*spool_, writer);
    records_[contour] = record;
}

std::optional<roofs::Roof> StoredRoofs::roof(std::size_t contour) const {
    if (places_[contour].size == 0)
        return {};
    ByteReader reader(*spool_, places_[contour]);
    roofs::Roof roof;
    roof.faces.resize(static_cast<std::size_t>(reader.take<std::uint64_t>()));
    for (roofs::RoofFace& face : roof.faces) {
        face.outline.exterior = reader.take_list<FinePoint>();
        face.outline.interiors.resize(static_cast<std::size_t>(reader.take<std::uint64_t>()));
        for (FineRing& ring : face.outline.interiors)
            ring = reader.take_list<FinePoint>();
        face.elevations = reader.take_list<double>();
        face.measure = reader.take<roofs::FaceMeasure>();
    }
    return roof;
}

}  // namespace d2b::features
