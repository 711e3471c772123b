#include "surface/label_contours.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "geometry/geos.hpp"

namespace d2b::surface {
namespace {

using Cell = std::pair<int, int>;  // row, column
using Cells = std::set<Cell>;

constexpr std::array<Cell, 4> neighbours{Cell{-1, 0}, Cell{0, -1}, Cell{1, 0}, Cell{0, 1}};

Cell plus(Cell a, Cell b) {
    return {a.first + b.first, a.second + b.second};
}

/// The cells that hang together with one by their edges.
Cells component(Cell start, const std::function<bool(Cell)>& is_in) {
    Cells cells{start};
    std::vector<Cell> open{start};
    while (!open.empty()) {
        const Cell cell = open.back();
        open.pop_back();
        for (const Cell& step : neighbours)
            if (const Cell next = plus(cell, step); is_in(next) && cells.insert(next).second)
                open.push_back(next);
    }
    return cells;
}

FinePoint fine_corner(Cell corner) {
    return fine(LatticePoint{corner.first, corner.second});
}

/// The rings around cells, which lie on the left. Corners where a ring runs on straight are left out, also
/// where another ring turns.
FinePolygon outline_of(const Cells& cells) {
    std::set<std::pair<Cell, Cell>> ways;  // from corner to corner
    for (const Cell& cell : cells) {
        const std::array<Cell, 4> corners{Cell{0, 0}, Cell{1, 0}, Cell{1, 1}, Cell{0, 1}};
        const std::array<Cell, 4> beside{Cell{0, -1}, Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}};
        for (std::size_t i = 0; i < 4; ++i)
            if (!cells.contains(plus(cell, beside[i])))
                ways.insert({plus(cell, corners[i]), plus(cell, corners[(i + 1) % 4])});
    }
    std::vector<FineRing> rings;
    while (!ways.empty()) {
        FineRing ring;
        auto [from, to] = *ways.begin();
        while (ways.erase({from, to}) > 0) {
            const Cell way{to.first - from.first, to.second - from.second};
            const Cell left{-way.second, way.first};  // a quarter turn, with rows to the south
            Cell next = plus(to, left);               // round the same cell where two ways lead on
            if (!ways.contains({to, next}) && ways.contains({to, plus(to, way)}))
                next = plus(to, way);
            else if (!ways.contains({to, next}))
                next = plus(to, {-left.first, -left.second});
            if (next != plus(to, way))
                ring.push_back(fine_corner(to));
            from = std::exchange(to, next);
        }
        rings.push_back(std::move(ring));
    }
    FinePolygon polygon;
    const auto area = [](const FineRing& ring) {
        std::int64_t sum = 0;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const FinePoint a = ring[i];
            const FinePoint b = ring[(i + 1) % ring.size()];
            sum += b.row * a.col - a.row * b.col;
        }
        return -sum;
    };
    for (FineRing& ring : rings)
        if (polygon.exterior.empty() && area(ring) > 0)
            polygon.exterior = std::move(ring);
        else
            polygon.interiors.push_back(std::move(ring));
    return polygon;
}

template <typename Visit>
void for_each_cell(const LetterGrid& grid, const Visit& visit) {
    for (int row = 0; row < static_cast<int>(grid.rows.size()); ++row)
        for (int col = 0; col < static_cast<int>(grid.rows[static_cast<std::size_t>(row)].size()); ++col)
            visit(Cell{row, col});
}

std::int64_t of_letter(const std::vector<std::int64_t>& values, char letter) {
    return values[std::min(values.size() - 1, static_cast<std::size_t>(letter - 'a'))];
}

/// Adds the contours of a stack from one level on. @param cells of the contour that they stand on
void add_stack(const LetterGrid& grid, const Cells& cells, char level, std::int32_t parent,
               SurfaceCluster& cluster) {
    Cells left = cells;
    while (!left.empty()) {
        const Cell start = *left.begin();
        const auto is_in = [&](Cell cell) {
            return cells.contains(cell) && grid.at(cell.first, cell.second) >= level;
        };
        if (!is_in(start)) {
            left.erase(start);
            continue;
        }
        const Cells part = component(start, is_in);
        for (const Cell& cell : part)
            left.erase(cell);
        const auto place = static_cast<std::int32_t>(cluster.contours.size());
        cluster.contours.push_back({outline_of(part), parent,
                                    static_cast<std::int32_t>(cluster.buildings.size()) - 1,
                                    10 * std::int64_t{level - '0'}});
        if (level < '9')
            add_stack(grid, part, static_cast<char>(level + 1), place, cluster);
    }
}

}  // namespace

SurfaceCluster blocks_of(const LetterGrid& grid, const std::vector<std::int64_t>& heights,
                         const std::vector<std::int64_t>& bases) {
    SurfaceCluster cluster;
    Cells seen;
    for_each_cell(grid, [&](Cell cell) {
        const char letter = grid.at(cell.first, cell.second);
        if (letter < 'a' || letter > 'z' || seen.contains(cell))
            return;
        const Cells cells = component(cell, [&](Cell c) { return grid.at(c.first, c.second) == letter; });
        seen.insert(cells.begin(), cells.end());
        const auto building = static_cast<std::int32_t>(cluster.buildings.size());
        cluster.buildings.push_back({100 + building, of_letter(bases, letter)});
        cluster.contours.push_back({outline_of(cells), -1, building, of_letter(heights, letter)});
    });
    return cluster;
}

SurfaceCluster stacks_of(const LetterGrid& grid) {
    SurfaceCluster cluster;
    Cells seen;
    for_each_cell(grid, [&](Cell cell) {
        const auto is_in = [&](Cell c) {
            const char digit = grid.at(c.first, c.second);
            return digit >= '1' && digit <= '9';
        };
        if (!is_in(cell) || seen.contains(cell))
            return;
        const Cells cells = component(cell, is_in);
        seen.insert(cells.begin(), cells.end());
        cluster.buildings.push_back({100 + static_cast<std::int64_t>(cluster.buildings.size()), 0});
        add_stack(grid, cells, '1', -1, cluster);
    });
    return cluster;
}

std::vector<FineTriangle> with_geos(const FinePolygon& polygon) {
    return Geos().triangles(polygon);
}

MadeSurfaces surfaces_of(const SurfaceCluster& cluster, const GapTolerances& gaps) {
    return make_surfaces(cluster, {true, true, 0, gaps}, with_geos);
}

}  // namespace d2b::surface
