#include "geometry/box.hpp"

namespace d2b {

Box box_of(std::span<const Position> positions) {
    Box box;
    for (const Position& p : positions)
        box.add(p);
    return box;
}

Box box_of(std::span<const WorldPolygon> polygons) {
    Box box;
    for (const WorldPolygon& polygon : polygons)
        box.add(box_of(std::span<const Position>(polygon.exterior)));
    return box;
}

}  // namespace d2b
