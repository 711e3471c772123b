#include "contours/contour.hpp"

namespace d2b::contours {

std::vector<Contour> fetch_all(const ContourList& contours) {
    std::vector<Contour> all;
    all.reserve(contours.size());
    for (std::size_t i = 0; i < contours.size(); ++i)
        all.push_back(contours.fetch(i));
    return all;
}

LatticePolygon traced_polygon(const Contour& contour) {
    LatticePolygon polygon{contour.exterior.corners(), {}};
    for (const PackedRing& ring : contour.interiors)
        polygon.interiors.push_back(ring.corners());
    return polygon;
}

void save(const Contour& contour, ByteWriter& writer) {
    writer.put(contour.own);
    writer.put(contour.above);
    writer.put(contour.lowest_outside);
    contour.exterior.save(writer);
    writer.put(static_cast<std::uint64_t>(contour.interiors.size()));
    for (const PackedRing& ring : contour.interiors)
        ring.save(writer);
}

Contour load_contour(ByteReader& reader) {
    Contour contour;
    contour.own = reader.take<PointStats>();
    contour.above = reader.take<PointStats>();
    contour.lowest_outside = reader.take<double>();
    contour.exterior = PackedRing::load(reader);
    contour.interiors.resize(reader.take_count(sizeof(std::uint64_t)));
    for (PackedRing& ring : contour.interiors)
        ring = PackedRing::load(reader);
    return contour;
}

}  // namespace d2b::contours
