#include "contours/reference.hpp"

#include <array>
#include <cmath>

namespace d2b::test {
namespace {

using Squares = std::set<LatticePoint>;

/// Whether a unit square qualifies at a level.
bool qualifies(const TraceGrid& grid, const std::vector<double>& thresholds, TraceMode mode, int level,
               LatticePoint s) {
    const int reach = mode == TraceMode::points ? 1 : 0;
    if (s.row < 0 || s.col < 0 || s.row + reach >= grid.rows || s.col + reach >= grid.cols)
        return false;
    const Label label = grid.label(s.row, s.col);
    for (int r = s.row; r <= s.row + reach; ++r)
        for (int c = s.col; c <= s.col + reach; ++c) {
            const double z = grid.at(r, c);
            if (std::isnan(z))
                return false;
            if (level > 0 && (label == 0 || grid.label(r, c) != label ||
                              !(z > thresholds[static_cast<std::size_t>(level - 1)])))
                return false;
        }
    return true;
}

std::array<LatticePoint, 4> neighbours(LatticePoint s) {
    return {{{s.row - 1, s.col}, {s.row + 1, s.col}, {s.row, s.col - 1}, {s.row, s.col + 1}}};
}

Squares flood(LatticePoint start, const Squares& all, const TraceGrid& grid, int level) {
    Squares found{start};
    std::vector<LatticePoint> todo{start};
    while (!todo.empty()) {
        const LatticePoint s = todo.back();
        todo.pop_back();
        for (const LatticePoint n : neighbours(s))
            if (all.count(n) != 0 && (level == 0 || grid.label(n.row, n.col) == grid.label(s.row, s.col)) &&
                found.insert(n).second)
                todo.push_back(n);
    }
    return found;
}

/// Background squares around a region, joined along edges; where the region meets itself in a corner its
/// squares are joined there, so the background on both sides is apart. The first piece is the outside.
std::vector<Squares> background(const Squares& region) {
    LatticePoint low = *region.begin();
    LatticePoint high = low;
    for (const LatticePoint s : region) {
        low = {std::min(low.row, s.row), std::min(low.col, s.col)};
        high = {std::max(high.row, s.row), std::max(high.col, s.col)};
    }
    Squares left;
    for (int r = low.row - 1; r <= high.row + 1; ++r)
        for (int c = low.col - 1; c <= high.col + 1; ++c)
            if (region.count({r, c}) == 0)
                left.insert({r, c});
    std::vector<Squares> pieces;
    while (!left.empty()) {
        Squares piece{*left.begin()};
        std::vector<LatticePoint> todo{*left.begin()};
        while (!todo.empty()) {
            const LatticePoint s = todo.back();
            todo.pop_back();
            for (const LatticePoint n : neighbours(s))
                if (left.count(n) != 0 && piece.insert(n).second)
                    todo.push_back(n);
        }
        for (const LatticePoint s : piece)
            left.erase(s);
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

std::int64_t shared_edges(const Squares& a, const Squares& b) {
    std::int64_t edges = 0;
    for (const LatticePoint s : a)
        for (const LatticePoint n : neighbours(s))
            edges += b.count(n) != 0 ? 1 : 0;
    return edges;
}

}  // namespace

std::vector<ReferenceContour> reference_contours(const TraceGrid& grid, const std::vector<double>& thresholds,
                                                 TraceMode mode) {
    std::vector<ReferenceContour> result;
    std::map<LatticePoint, LatticePoint> below;
    for (int level = 0; level <= static_cast<int>(thresholds.size()); ++level) {
        Squares all;
        for (int r = 0; r < grid.rows; ++r)
            for (int c = 0; c < grid.cols; ++c)
                if (qualifies(grid, thresholds, mode, level, {r, c}))
                    all.insert({r, c});
        std::map<LatticePoint, LatticePoint> first_of;
        for (const LatticePoint start : all) {
            if (first_of.count(start) != 0)
                continue;
            ReferenceContour contour;
            contour.level = level;
            contour.squares = flood(start, all, grid, level);
            for (const LatticePoint s : contour.squares)
                first_of[s] = start;
            if (level > 0)
                contour.parent_first = below.at(start);
            const auto pieces = background(contour.squares);
            contour.exterior_points = shared_edges(contour.squares, pieces.front());
            contour.interiors = pieces.size() - 1;
            result.push_back(std::move(contour));
        }
        below = std::move(first_of);
    }
    return result;
}

std::set<LatticePoint> squares_inside(const contours::Contour& contour) {
    std::vector<LatticeRing> rings{contour.exterior.corners()};
    for (const PackedRing& ring : contour.interiors)
        rings.push_back(ring.corners());
    std::set<LatticePoint> inside;
    const LatticeBox box = contour.exterior.box();
    for (int r = box.low.row; r < box.high.row; ++r)
        for (int c = box.low.col; c < box.high.col; ++c) {
            int crossings = 0;
            for (const LatticeRing& ring : rings)
                for (std::size_t i = 0; i < ring.size(); ++i) {
                    const LatticePoint a = ring[i];
                    const LatticePoint b = ring[(i + 1) % ring.size()];
                    if (a.col == b.col && a.col > c && std::min(a.row, b.row) <= r &&
                        r < std::max(a.row, b.row))
                        ++crossings;
                }
            if (crossings % 2 == 1)
                inside.insert({r, c});
        }
    return inside;
}

}  // namespace d2b::test
