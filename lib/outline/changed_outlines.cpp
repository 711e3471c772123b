#include "outline/changed_outlines.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "geometry/box_tree.hpp"
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

/// Edges of a polygon in an R-tree.
class NearEdges {
  public:
    NearEdges(const FinePolygon& polygon, const CellShape& shape) : shape_(shape), tree_(boxes(polygon)) {}

    /// Distance in cells from the nearest edge. Searches a growing box, because scanning all edges is rarely
    /// necessary.
    [[nodiscard]] double distance_to(FinePoint point) const;

  private:
    std::vector<Box> boxes(const FinePolygon& polygon) {
        std::vector<Box> boxes;
        for (const FineRing* ring : rings_of(polygon))
            for (std::size_t i = 0; i < ring->size(); ++i) {
                edges_.emplace_back((*ring)[i], (*ring)[i + 1 == ring->size() ? 0 : i + 1]);
                Box& box = boxes.emplace_back();
                for (const FinePoint& end : {edges_.back().first, edges_.back().second})
                    box.add(Position{static_cast<double>(end.col), static_cast<double>(end.row)});
            }
        return boxes;
    }

    const CellShape& shape_;
    std::vector<std::pair<FinePoint, FinePoint>> edges_;
    BoxTree tree_;
};

double distance(Vec p, Vec a, Vec b) {
    const double square = dot(b - a, b - a);
    const double share = square > 0 ? std::clamp(dot(p - a, b - a) / square, 0.0, 1.0) : 0;
    return length(p - (a + share * (b - a)));
}

double NearEdges::distance_to(FinePoint point) const {
    const auto vec = [&](FinePoint p) { return shape_.from_fine(p, {}); };
    constexpr double widest = 1e9;
    double least = std::numeric_limits<double>::infinity();
    double cells = 2;
    while (cells < widest && least > cells) {
        const double steps = cells * FinePoint::steps * shape_.longer_side();
        const auto x = static_cast<double>(point.col);
        const auto y = static_cast<double>(point.row);
        tree_.query({x - steps, y - steps, x + steps, y + steps}, [&](std::size_t i) {
            least = std::min(least, distance(vec(point), vec(edges_[i].first), vec(edges_[i].second)));
        });
        cells *= 4;
    }
    return least;
}

/// Largest distance between the corners of one polygon that the other lacks and the other's edges.
double farthest(const FinePolygon& from, const FinePolygon& to, const CellShape& shape) {
    std::set<FinePoint> known;
    for (const FineRing* ring : rings_of(to))
        known.insert(ring->begin(), ring->end());
    const NearEdges edges(to, shape);
    double most = 0;
    for (const FineRing* corners : rings_of(from))
        for (const FinePoint& corner : *corners)
            if (!known.contains(corner))
                most = std::max(most, edges.distance_to(corner));
    return most;
}

}  // namespace

void ChangedOutlines::put(std::size_t place, const FinePolygon& outline, const OutlineQuality& quality) {
    ByteWriter writer;
    save(outline, writer);
    kept_[place] = {append(*spool_, writer), quality};
}

const ChangedOutlines::Kept* ChangedOutlines::find(std::size_t place) const {
    const auto found = kept_.find(place);
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
