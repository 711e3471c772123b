#include "surface/partition.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

#include "core/for_rings.hpp"
#include "geometry/box_tree.hpp"
#include "outline/fine_geometry.hpp"

namespace d2b::surface {

/// Edge of an outline, with the interior of its contour on the left.
struct OutlineEdge {
    FinePoint from;
    FinePoint to;
    std::uint32_t contour = 0;
};

/// Edges of all outlines, ring by ring, and their intersections.
struct OutlineEdges {
    std::vector<OutlineEdge> sides;  ///< none of zero length
    std::vector<std::vector<FinePoint>>
        cuts;  ///< per side: vertices of other outlines in its interior, in its direction
    std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing;  ///< pairs of contours whose edges cross
};

[[nodiscard]] OutlineEdges outline_edges(std::span<const PartitionContour> contours, const StopToken& stop);

namespace {

void add_ring(const FineRing& ring, std::uint32_t contour, std::vector<OutlineEdge>& sides) {
    for (std::size_t i = 0; i < ring.size(); ++i)
        if (const FinePoint to = ring[i + 1 == ring.size() ? 0 : i + 1]; ring[i] != to)
            sides.push_back({ring[i], to, contour});
}

/// Returns true if a point is in the interior of a side.
bool is_within(const OutlineEdge& side, FinePoint point) {
    return point != side.from && point != side.to &&
           outline::boxes_intersect({side.from, side.to}, {point, point}) &&
           d2b::outline::side(side.from, side.to, point) == 0;
}

/// Returns true if two sides cross properly, in a point that is not an end of either.
bool cross(const OutlineEdge& s, const OutlineEdge& t) {
    return outline::side(s.from, s.to, t.from) * outline::side(s.from, s.to, t.to) < 0 &&
           outline::side(t.from, t.to, s.from) * outline::side(t.from, t.to, s.to) < 0;
}

/// Sorts along the direction of a side and removes duplicates.
void sort_along(const OutlineEdge& side, std::vector<FinePoint>& points) {
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (side.to < side.from)
        std::ranges::reverse(points);
}

/// Side, or the part of it between two cuts, directed from its lower node.
struct Piece {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    bool forwards = true;  // the contour is on the left of the direction from low to high
    std::uint32_t contour = 0;

    friend auto operator<=>(const Piece&, const Piece&) = default;
};

/// Contours on one side of a piece, one standing on the other.
struct Stack {
    std::int32_t lowest = open_ground;   // contour that stands on none of the others
    std::int32_t highest = open_ground;  // contour that stands on all the others
};

class Partitioner {
  public:
    Partitioner(std::span<const PartitionContour> contours, const StopToken& stop)
        : contours_(contours), stop_(stop) {}

    [[nodiscard]] PartitionResult make();

  private:
    [[nodiscard]] std::vector<Piece> pieces(const OutlineEdges& sides);
    void add_edge(std::span<const Piece> alike);
    [[nodiscard]] std::optional<Stack> stack(std::span<const Piece> pieces);
    [[nodiscard]] std::int32_t below(const Stack& stack) const {
        return contours_[static_cast<std::size_t>(stack.lowest)].parent;
    }
    void look_around_nodes();
    void refuse(std::int32_t a, std::int32_t b) {
        result_.conflicting.push_back(static_cast<std::uint32_t>(std::max(a, b)));
    }

    std::span<const PartitionContour> contours_;
    const StopToken& stop_;
    PartitionResult result_;
};

std::vector<FinePoint> distinct_ends(const OutlineEdges& sides) {
    std::vector<FinePoint> points;
    points.reserve(sides.sides.size());
    for (const OutlineEdge& side : sides.sides)
        points.push_back(side.from);
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

std::vector<Piece> Partitioner::pieces(const OutlineEdges& sides) {
    const std::vector<FinePoint>& nodes = result_.plan.nodes = distinct_ends(sides);
    const auto node = [&](FinePoint point) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(nodes, point) - nodes.begin());
    };
    std::vector<Piece> pieces;
    const auto add = [&](std::uint32_t from, std::uint32_t to, std::uint32_t contour) {
        pieces.push_back({std::min(from, to), std::max(from, to), from < to, contour});
    };
    for (std::size_t i = 0; i < sides.sides.size(); ++i) {
        const OutlineEdge& side = sides.sides[i];
        std::uint32_t from = node(side.from);
        for (const FinePoint& cut : sides.cuts[i]) {
            const std::uint32_t to = node(cut);
            add(from, to, side.contour);
            from = to;
        }
        add(from, node(side.to), side.contour);
    }
    std::ranges::sort(pieces);
    return pieces;
}

/// @param pieces on one side, ascending contours @return nothing if they do not form a chain of parents
std::optional<Stack> Partitioner::stack(std::span<const Piece> pieces) {
    Stack stack;
    for (const Piece& piece : pieces) {
        const auto contour = static_cast<std::int32_t>(piece.contour);
        if (stack.lowest == open_ground) {
            stack.lowest = contour;
        } else if (contours_[piece.contour].parent != stack.highest) {
            refuse(contour, stack.highest);
            return std::nullopt;
        }
        stack.highest = contour;
    }
    return stack;
}

/// @param alike all pieces between two nodes, backward ones first
void Partitioner::add_edge(std::span<const Piece> alike) {
    const auto split = std::ranges::partition_point(alike, [](const Piece& p) { return !p.forwards; });
    const auto before = static_cast<std::size_t>(split - alike.begin());
    const std::optional<Stack> right = stack(alike.first(before));
    const std::optional<Stack> left = stack(alike.subspan(before));
    if (!left || !right)
        return;
    const bool both = left->lowest != open_ground && right->lowest != open_ground;
    if (both && below(*left) != below(*right)) {
        refuse(left->lowest, right->lowest);
        return;
    }
    const PartitionEdge edge{alike.front().low, alike.front().high,
                             left->lowest != open_ground ? left->highest : below(*right),
                             right->lowest != open_ground ? right->highest : below(*left)};
    if (edge.left != edge.right)
        result_.plan.edges.push_back(edge);
}

/// Checks that consecutive edges around each node agree on the sector between them.
void Partitioner::look_around_nodes() {
    for (const std::vector<IncidentEdge>& arms : edges_around_nodes(result_.plan))
        for (std::size_t i = 0; i < arms.size(); ++i)
            if (const IncidentEdge& next = arms[i + 1 == arms.size() ? 0 : i + 1]; arms[i].left != next.right)
                refuse(arms[i].left, next.right);
}

PartitionResult Partitioner::make() {
    const OutlineEdges sides = outline_edges(contours_, stop_);
    for (const auto& [a, b] : sides.crossing)
        refuse(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
    if (!result_.conflicting.empty())
        return std::move(result_);
    const std::vector<Piece> all = pieces(sides);
    for (std::size_t begin = 0; begin < all.size();) {
        stop_.check();
        std::size_t end = begin + 1;
        while (end < all.size() &&
               std::tie(all[end].low, all[end].high) == std::tie(all[begin].low, all[begin].high))
            ++end;
        add_edge(std::span(all).subspan(begin, end - begin));
        begin = end;
    }
    if (result_.conflicting.empty())
        look_around_nodes();
    return std::move(result_);
}

}  // namespace

OutlineEdges outline_edges(std::span<const PartitionContour> contours, const StopToken& stop) {
    OutlineEdges result;
    std::vector<OutlineEdge>& sides = result.sides;
    for (std::uint32_t c = 0; c < contours.size(); ++c)
        for_rings(contours[c].outline, [&](const FineRing& ring) { add_ring(ring, c, sides); });
    std::vector<Box> boxes(sides.size());
    std::ranges::transform(sides, boxes.begin(), [](const OutlineEdge& side) {
        return box_of({side.from, side.to});
    });
    const BoxTree tree(boxes);
    result.cuts.resize(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
        stop.check();
        tree.query(boxes[i], [&](std::size_t k) {
            if (is_within(sides[i], sides[k].from))
                result.cuts[i].push_back(sides[k].from);
            if (i < k && cross(sides[i], sides[k]))
                result.crossing.emplace_back(sides[i].contour, sides[k].contour);
        });
        sort_along(sides[i], result.cuts[i]);
    }
    return result;
}

PartitionResult make_partition(std::span<const PartitionContour> contours, const StopToken& stop) {
    return Partitioner(contours, stop).make();
}

std::vector<FinePolygon> noded_outlines(std::span<const PartitionContour> contours) {
    const OutlineEdges sides = outline_edges(contours, {});
    std::size_t next = 0;
    const auto noded = [&](const FineRing& ring) {
        FineRing result;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            if (ring[i] == ring[i + 1 == ring.size() ? 0 : i + 1])
                continue;
            result.push_back(ring[i]);
            result.insert(result.end(), sides.cuts[next].begin(), sides.cuts[next].end());
            ++next;
        }
        return result;
    };
    std::vector<FinePolygon> outlines;
    for (const PartitionContour& contour : contours) {
        FinePolygon& outline = outlines.emplace_back(FinePolygon{noded(contour.outline.exterior), {}});
        for (const FineRing& ring : contour.outline.interiors)
            outline.interiors.push_back(noded(ring));
    }
    return outlines;
}

}  // namespace d2b::surface
