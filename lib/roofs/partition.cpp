#include "roofs/partition.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/for_rings.hpp"
#include "geometry/box_tree.hpp"
#include "outline/fine_geometry.hpp"
#include "raster/row_spans.hpp"

namespace d2b::roofs {
namespace {

constexpr double steps_per_cell = static_cast<double>(FinePoint::steps * roof_steps);
/// Cells: a line that crosses a wall this near to a corner ends in the corner.
constexpr double corner_reach = 0.8;

template <typename Use>
void for_edges(const FineRing& ring, const Use& use) {
    for (std::size_t i = 0; i < ring.size(); ++i)
        use(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]);
}

template <typename Use>
void for_edges(const FinePolygon& polygon, const Use& use) {
    for_rings(polygon, [&](const FineRing& ring) { for_edges(ring, use); });
}

/// Returns a polygon with all its corners moved. @param move returns the new place of a corner
template <typename Move>
FinePolygon moved(const FinePolygon& polygon, const Move& move) {
    FinePolygon result{polygon.exterior, polygon.interiors};
    for_rings(result, [&](FineRing& ring) { std::ranges::transform(ring, ring.begin(), move); });
    return result;
}

/// Share of a segment at which it crosses another.
std::optional<double> crossing(const FineSegment& segment, FinePoint a, FinePoint b) {
    const auto dx = static_cast<double>(segment.to.col - segment.from.col);
    const auto dy = static_cast<double>(segment.to.row - segment.from.row);
    const auto ex = static_cast<double>(b.col - a.col);
    const auto ey = static_cast<double>(b.row - a.row);
    const double determinant = dx * ey - dy * ex;
    if (determinant == 0)
        return {};
    const auto fx = static_cast<double>(a.col - segment.from.col);
    const auto fy = static_cast<double>(a.row - segment.from.row);
    const double along = (fx * ey - fy * ex) / determinant;
    const double across = (fx * dy - fy * dx) / determinant;
    if (along < 0 || along > 1 || across < 0 || across > 1)
        return {};
    return along;
}

/// Leads lines that cross a wall near a corner of the footprint through the corner: hips and valleys end
/// there.
std::vector<FineSegment> through_corners(const FinePolygon& footprint, const std::vector<FineSegment>& lines,
                                         const StopToken& stop) {
    std::vector<FineSegment> walls;
    std::vector<Box> boxes;
    for_edges(footprint, [&](FinePoint a, FinePoint b) {
        walls.push_back({a, b});
        boxes.push_back(box_of(walls.back()));
    });
    const BoxTree tree(boxes);
    std::vector<FineSegment> result;
    for (const FineSegment& line : lines) {
        stop.check();
        std::vector<std::pair<double, FinePoint>> stops;
        tree.query(box_of(line), [&](std::size_t i) {
            const auto& [a, b] = walls[i];
            const std::optional<double> share = crossing(line, a, b);
            if (!share)
                return;
            const FinePoint at = outline::point_between(line.from, line.to, *share);
            const FinePoint near = outline::step_distance(at, a) < outline::step_distance(at, b) ? a : b;
            if (outline::step_distance(at, near) < corner_reach * steps_per_cell)
                stops.emplace_back(*share, near);
        });
        std::ranges::sort(stops);
        FinePoint from = line.from;
        for (const auto& [share, corner] : stops)
            if (corner != from) {
                result.push_back({from, corner});
                from = corner;
            }
        if (from != line.to)
            result.push_back({from, line.to});
    }
    return result;
}

std::int32_t label_of(const FinePolygon& face, const std::vector<std::int32_t>& labels,
                      const BuildingGrid& grid, const RoofLattice& lattice) {
    std::map<std::int32_t, std::int64_t> counts;
    for (const std::size_t cell : cells_of(face, grid, lattice))
        ++counts[labels[cell]];
    std::int32_t best = -1;
    std::int64_t most = 0;
    for (const auto& [label, count] : counts)
        if (count > most) {
            most = count;
            best = label;
        }
    return best;
}

/// Label of the cell with a point.
std::int32_t label_at(FinePoint point, const std::vector<std::int32_t>& labels, const BuildingGrid& grid,
                      const RoofLattice& lattice) {
    const FinePoint at = lattice.in_grid(point);
    const auto row =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(at.row / FinePoint::steps, 0, grid.rows - 1));
    const auto col =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(at.col / FinePoint::steps, 0, grid.cols - 1));
    return labels[grid.index(row, col)];
}

/// Gives faces without a label that of the neighbour with the longest edge.
void label_all(const std::vector<FaceEdge>& edges, std::vector<LabelledFace>& faces) {
    for (bool changed = true; std::exchange(changed, false);) {
        std::vector<std::map<std::int32_t, double>> beside(faces.size());  // length by label
        for (const FaceEdge& edge : edges) {
            if (edge.left < 0 || edge.right < 0)
                continue;
            const double length = outline::step_distance(edge.from, edge.to);
            const auto left = static_cast<std::size_t>(edge.left);
            const auto right = static_cast<std::size_t>(edge.right);
            beside[left][faces[right].label] += length;
            beside[right][faces[left].label] += length;
        }
        for (std::size_t i = 0; i < faces.size(); ++i) {
            if (faces[i].label >= 0)
                continue;
            beside[i].erase(-1);
            const auto longest =
                std::ranges::max_element(beside[i], {}, &std::pair<const std::int32_t, double>::second);
            if (longest == beside[i].end())
                continue;
            faces[i].label = longest->first;
            changed = true;
        }
    }
}

}  // namespace

FinePolygon refined(const FinePolygon& polygon) {
    return moved(polygon, [](FinePoint p) { return FinePoint{p.row * roof_steps, p.col * roof_steps}; });
}

std::vector<LabelledFace> dissolve(std::vector<LabelledFace> faces, Geos& geos) {
    const std::vector<FaceEdge> edges = face_edges(faces);
    label_all(edges, faces);
    std::vector<FineSegment> kept;
    std::map<std::pair<FinePoint, FinePoint>, std::int32_t> left;  // label on the left of an edge
    for (const FaceEdge& edge : edges) {
        const std::int32_t a = edge.left < 0 ? -2 : faces[static_cast<std::size_t>(edge.left)].label;
        const std::int32_t b = edge.right < 0 ? -2 : faces[static_cast<std::size_t>(edge.right)].label;
        if (a == b)
            continue;
        kept.push_back({edge.from, edge.to});
        left[{edge.from, edge.to}] = a;
        left[{edge.to, edge.from}] = b;
    }
    std::vector<LabelledFace> result;
    for (FinePolygon& outline : geos.polygonize(kept)) {
        const auto label = left.find({outline.exterior[0], outline.exterior[1]});
        // Courtyards are polygons as well.
        if (label != left.end() && label->second != -2)
            result.push_back({std::move(outline), label->second});
    }
    return result;
}

double area_in_cells(const FinePolygon& polygon) {
    double twice = 0;
    for_edges(polygon, [&](FinePoint a, FinePoint b) {
        const FinePoint& origin = polygon.exterior.front();
        twice += static_cast<double>(a.col - origin.col) * static_cast<double>(b.row - origin.row) -
                 static_cast<double>(b.col - origin.col) * static_cast<double>(a.row - origin.row);
    });
    return std::abs(twice) / 2 / (steps_per_cell * steps_per_cell);
}

FinePoint RoofLattice::point(const Vec2& p) const {
    return {std::llround((grid_.row(p.y) + grid_.first_row + shift_) * steps_per_cell),
            std::llround((grid_.col(p.x) + grid_.first_col + shift_) * steps_per_cell)};
}

Vec2 RoofLattice::position(FinePoint p) const {
    return {grid_.x(static_cast<double>(p.col) / steps_per_cell - grid_.first_col - shift_),
            grid_.y(static_cast<double>(p.row) / steps_per_cell - grid_.first_row - shift_)};
}

FinePoint RoofLattice::in_grid(FinePoint p) const {
    constexpr auto steps = static_cast<double>(FinePoint::steps);
    return {std::llround(static_cast<double>(p.row) / roof_steps - (grid_.first_row + shift_) * steps),
            std::llround(static_cast<double>(p.col) / roof_steps - (grid_.first_col + shift_) * steps)};
}

std::vector<std::size_t> cells_of(const FinePolygon& face, const BuildingGrid& grid,
                                  const RoofLattice& lattice) {
    const FinePolygon local = moved(face, [&](FinePoint p) { return lattice.in_grid(p); });
    std::vector<std::size_t> cells;
    for (const RowSpan& span : row_spans(local))
        for (std::int32_t col = std::max(span.begin, 0); col < std::min(span.end, grid.cols); ++col)
            if (span.row >= 0 && span.row < grid.rows)
                cells.push_back(grid.index(span.row, col));
    return cells;
}

std::vector<FaceEdge> face_edges(const std::vector<LabelledFace>& faces) {
    std::map<std::pair<FinePoint, FinePoint>, FaceEdge> edges;
    for (std::size_t i = 0; i < faces.size(); ++i)
        for_edges(faces[i].outline, [&](FinePoint a, FinePoint b) {
            const bool forwards = a < b;
            FaceEdge& edge = edges[forwards ? std::pair(a, b) : std::pair(b, a)];
            edge.from = forwards ? a : b;
            edge.to = forwards ? b : a;
            (forwards ? edge.left : edge.right) = static_cast<std::int32_t>(i);
        });
    std::vector<FaceEdge> result;
    result.reserve(edges.size());
    for (const auto& [ends, edge] : edges)
        result.push_back(edge);
    return result;
}

std::vector<LabelledFace> partition(const FinePolygon& footprint, const std::vector<BorderLine>& lines,
                                    const std::vector<std::int32_t>& labels, const BuildingGrid& grid,
                                    const RoofLattice& lattice, Geos& geos, const StopToken& stop) {
    constexpr double least_area = 1;  // cells
    std::vector<FineSegment> segments;
    for (const BorderLine& line : lines) {
        const FineSegment segment{lattice.point(line.from), lattice.point(line.to)};
        if (segment.from != segment.to)
            segments.push_back(segment);
    }
    std::vector<LabelledFace> faces;
    if (segments.empty())
        faces.push_back({footprint, 0});
    else
        for (FinePolygon& outline : geos.divide(footprint, through_corners(footprint, segments, stop)))
            faces.push_back({std::move(outline), 0});
    for (LabelledFace& face : faces)
        face.label = label_of(face.outline, labels, grid, lattice);
    if (faces.size() == 1) {
        if (faces[0].label < 0)
            faces[0].label = label_at(footprint.exterior.front(), labels, grid, lattice);
        return faces;
    }
    faces = dissolve(std::move(faces), geos);
    for (LabelledFace& face : faces)
        if (area_in_cells(face.outline) < least_area)
            face.label = -1;
    faces = dissolve(std::move(faces), geos);
    for (LabelledFace& face : faces)
        if (face.label < 0)
            face.label = label_at(face.outline.exterior.front(), labels, grid, lattice);
    return faces;
}

}  // namespace d2b::roofs
