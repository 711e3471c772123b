#include "outline/changed_outlines.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include "outline/fine_geometry.hpp"
#include "outline/packed_outline.hpp"

namespace d2b {
namespace {

std::vector<const FineRing*> rings_of(const FinePolygon& polygon) {
    std::vector<const FineRing*> rings{&polygon.exterior};
    for (const FineRing& ring : polygon.interiors)
        rings.push_back(&ring);
    return rings;
}

double twice_area(const FinePolygon& polygon) {
    Int128 sum = 0;
    for (const FineRing* ring : rings_of(polygon))
        for (std::size_t i = 1; i + 1 < ring->size(); ++i)
            sum += turn((*ring)[0], (*ring)[i], (*ring)[i + 1]);
    return static_cast<double>(sum);
}

double distance(Vec p, Vec a, Vec b) {
    const double square = dot(b - a, b - a);
    const double share = square > 0 ? std::clamp(dot(p - a, b - a) / square, 0.0, 1.0) : 0;
    return length(p - (a + share * (b - a)));
}

/// How far those corners of one that the other lacks are from its edges.
double farthest(const FinePolygon& from, const FinePolygon& to, const CellShape& shape) {
    std::set<FinePoint> known;
    for (const FineRing* ring : rings_of(to))
        known.insert(ring->begin(), ring->end());
    const auto vec = [&](FinePoint p) { return shape.from_fine(p, {}); };
    double most = 0;
    for (const FineRing* corners : rings_of(from))
        for (const FinePoint& corner : *corners) {
            if (known.contains(corner))
                continue;
            double least = std::numeric_limits<double>::infinity();
            for (const FineRing* ring : rings_of(to))
                for (std::size_t i = 0; i < ring->size(); ++i)
                    least = std::min(least, distance(vec(corner), vec((*ring)[i]),
                                                     vec((*ring)[i + 1 == ring->size() ? 0 : i + 1])));
            most = std::max(most, least);
        }
    return most;
}

}  // namespace

void ChangedOutlines::put(std::size_t contour, const FinePolygon& outline, const OutlineQuality& quality) {
    ByteWriter writer;
    save(outline, writer);
    kept_[contour] = {append(*spool_, writer), quality};
}

const ChangedOutlines::Kept* ChangedOutlines::find(std::size_t contour) const {
    const auto found = kept_.find(contour);
    return found == kept_.end() ? nullptr : &found->second;
}

FinePolygon ChangedOutlines::outline(const Kept& kept) const {
    return load_outline(*spool_, kept.place);
}

double ChangedOutlines::grown(const FinePolygon& before, const FinePolygon& after) {
    return twice_area(after) / twice_area(before);
}

double ChangedOutlines::apart_cells(const FinePolygon& before, const FinePolygon& after,
                                    const CellShape& shape) {
    return std::max(farthest(before, after, shape), farthest(after, before, shape));
}

}  // namespace d2b
